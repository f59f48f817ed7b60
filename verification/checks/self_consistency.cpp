#include "verification/checks/self_consistency.h"

#include "verification/checks/input_families.h"
#include "verification/checks/verdict_builder.h"
#include "verification/finite_difference/ridders.h"

#include <algorithm>

namespace irradiff {
namespace {

/// First step, relative to distances of order 1: F is analytic within the distance to the nearest edge, at least 0.3 in
/// this family.
constexpr double kStep = 0.04;

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
  return verdicts;
}

}  // namespace irradiff
