#include "verification/checks/self_consistency.h"

#include "derivatives/boundary/irradiance.h"
#include "verification/checks/input_families.h"
#include "verification/checks/verdict_builder.h"
#include "verification/finite_difference/ridders.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

/// First step, relative to distances of order 1: F is analytic within the distance to the nearest edge, at least 0.3 in
/// this family.
constexpr double kStep = 0.04;
/// First turn of the normal, in radians: every vertex of this family stays above the horizon.
constexpr double kFirstTurn = 0.1;

Configuration shifted(const Configuration& input, int axis, double step) {
  Configuration result = input;
  result.receiver.position(axis) += step;
  return result;
}

/// Differences of one entry of a candidate's value along one axis.
template <class Entry>
DifferenceResult<double> difference(const Configuration& input, int axis, double evaluation_error, const Entry& entry) {
  return riddersDerivative<double>([&](double h) { return entry(shifted(input, axis, h)); }, kStep, evaluation_error);
}

}  // namespace

std::vector<Verdict> checkSelfConsistency(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                          double tolerance) {
  const std::vector<Configuration> drawn = drawInputs(inputFamily("well-conditioned"), inputs, seed);
  const char* rule = "the promise, above the difference's own error estimate";
  std::vector<Verdict> verdicts;
  if (candidate.form_factor && candidate.gradient) {
    VerdictBuilder builder(candidate.name, "differences of its own form factor", "well-conditioned",
                           Quantity::kGradient, tolerance, rule);
    for (const Configuration& input : drawn) {
      builder.attempt(input, [&] {
        const double evaluation_error = tolerance * std::abs(candidate.form_factor(input)) + 0x1p-53;
        Eigen::Vector3d expected;
        double error = 0.0;
        for (int i = 0; i < 3; ++i) {
          const auto slope =
              difference(input, i, evaluation_error, [&](const Configuration& c) { return candidate.form_factor(c); });
          expected(i) = slope.value;
          error = std::max(error, slope.error);
        }
        const Eigen::Vector3d actual = candidate.gradient(input);
        const double norm = expected.cwiseAbs().maxCoeff();
        builder.add((actual - expected).cwiseAbs().maxCoeff() / norm, error / norm, input, expected, actual);
      });
    }
    verdicts.push_back(builder.finish());
  }
  if (candidate.gradient && candidate.hessian) {
    VerdictBuilder builder(candidate.name, "differences of its own gradient", "well-conditioned", Quantity::kHessian,
                           tolerance, rule);
    for (const Configuration& input : drawn) {
      builder.attempt(input, [&] {
        const double evaluation_error = tolerance * candidate.gradient(input).cwiseAbs().maxCoeff() + 0x1p-53;
        Eigen::Matrix3d expected;
        double error = 0.0;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) {
            const auto slope = difference(input, j, evaluation_error,
                                          [&](const Configuration& c) { return candidate.gradient(c)(i); });
            expected(i, j) = slope.value;
            error = std::max(error, slope.error);
          }
        }
        const Eigen::Matrix3d actual = candidate.hessian(input);
        const double norm = expected.cwiseAbs().maxCoeff();
        builder.add((actual - expected).cwiseAbs().maxCoeff() / norm, error / norm, input, expected, actual);
      });
    }
    verdicts.push_back(builder.finish());
  }
  if (candidate.gradient && candidate.tangential_hessian) {
    VerdictBuilder builder(candidate.name, "differences of its own gradient", "well-conditioned",
                           Quantity::kTangentialHessian, tolerance, rule);
    for (const Configuration& input : drawn) {
      builder.attempt(input, [&] {
        const double evaluation_error = tolerance * candidate.gradient(input).cwiseAbs().maxCoeff() + 0x1p-53;
        const Eigen::Matrix<double, 3, 2> axes = tangentFrame<double>(input.receiver.normal);
        Eigen::Matrix2d expected;
        double error = 0.0;
        for (int a = 0; a < 2; ++a) {
          for (int b = 0; b < 2; ++b) {
            const auto slope = riddersDerivative<double>(
                [&](double h) {
                  Configuration moved = input;
                  moved.receiver.position += h * axes.col(b);
                  return axes.col(a).dot(candidate.gradient(moved));
                },
                kStep, evaluation_error);
            expected(a, b) = slope.value;
            error = std::max(error, slope.error);
          }
        }
        const Eigen::Matrix2d actual = candidate.tangential_hessian(input);
        const double norm = expected.cwiseAbs().maxCoeff();
        builder.add((actual - expected).cwiseAbs().maxCoeff() / norm, error / norm, input, expected, actual);
      });
    }
    verdicts.push_back(builder.finish());
  }
  if (candidate.form_factor && candidate.rotational_gradient) {
    VerdictBuilder builder(candidate.name, "differences over the normal", "well-conditioned",
                           Quantity::kRotationalGradient, tolerance, rule);
    for (const Configuration& input : drawn) {
      builder.attempt(input, [&] {
        const double evaluation_error = tolerance * std::abs(candidate.form_factor(input)) + 0x1p-53;
        const Eigen::Matrix<double, 3, 2> axes = tangentFrame<double>(input.receiver.normal);
        Eigen::Vector3d expected = Eigen::Vector3d::Zero();
        double error = 0.0;
        for (int k = 0; k < 2; ++k) {
          const auto slope = riddersDerivative<double>(
              [&](double angle) {
                Configuration turned = input;
                turned.receiver.normal = Eigen::AngleAxisd(angle, axes.col(k)) * input.receiver.normal;
                return candidate.form_factor(turned);
              },
              kFirstTurn, evaluation_error);
          expected += slope.value * axes.col(k);
          error += slope.error;
        }
        const Eigen::Vector3d actual = candidate.rotational_gradient(input);
        const double norm = std::max(expected.cwiseAbs().maxCoeff(), std::abs(candidate.form_factor(input)));
        builder.add((actual - expected).cwiseAbs().maxCoeff() / norm, error / norm, input, expected, actual);
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

}  // namespace irradiff
