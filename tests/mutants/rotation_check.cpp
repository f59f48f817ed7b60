#include "tests/mutants/rotation_check.h"

#include "derivatives/boundary/irradiance.h"
#include "verification/checks/random.h"
#include "verification/checks/verdict_builder.h"
#include "verification/finite_difference/ridders.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

constexpr const char* kCheck = "differences over the normal";
constexpr const char* kRule = "the promise, above the difference's own error estimate";
/// Radians. Every vertex of these inputs stays above the horizon.
constexpr double kFirstTurn = 0.1;

}  // namespace

Verdict checkRotationalGradient(const FormulaLibrary& formulas, PolygonFormula formula,
                                const std::vector<Configuration>& inputs, const std::string& family, double tolerance) {
  const Candidate candidate = formulas.candidate(formula);
  VerdictBuilder builder(formulas.name(), kCheck, family, Quantity::kGradient, tolerance, kRule);
  for (const Configuration& input : inputs) {
    builder.attempt(input, [&] {
      const Eigen::Matrix<double, 3, 2> axes = tangentFrame<double>(input.receiver.normal);
      const double evaluation_error = tolerance * std::abs(candidate.form_factor(input));
      Eigen::Vector2d expected;
      double error = 0.0;
      for (int k = 0; k < 2; ++k) {
        const auto slope = riddersDerivative<double>(
            [&](double angle) {
              Configuration turned = input;
              turned.receiver.normal = Eigen::AngleAxisd(angle, axes.col(k)) * input.receiver.normal;
              return candidate.form_factor(turned);
            },
            kFirstTurn, evaluation_error);
        expected(k) = slope.value;
        error = std::max(error, slope.error);
      }
      const Eigen::Vector2d actual = axes.transpose() * formulas.rotationalGradient(formula, input);
      const double norm = expected.cwiseAbs().maxCoeff();
      builder.add((actual - expected).cwiseAbs().maxCoeff() / norm, error / norm, input, expected, actual);
    });
  }
  return builder.finish();
}

Verdict checkFlatlandRotationalGradient(const FormulaLibrary& formulas, std::size_t inputs, std::uint64_t seed,
                                        double tolerance) {
  const FlatlandCandidate candidate = formulas.flatlandCandidate();
  VerdictBuilder builder(formulas.name(), kCheck, "flatland", Quantity::kGradient, tolerance, kRule);
  for (std::size_t i = 0; i < inputs; ++i) {
    KeyedRandom random(seed, "flatland, turned normals", i);
    const auto facing = [](double angle) { return Eigen::Vector2d(std::sin(angle), std::cos(angle)); };
    const double tilt = random.between(-0.3, 0.3);
    const Segment segment{
        "segment",
        {{{random.between(-1.0, 0.0), random.between(0.5, 1.0)}, {random.between(0.2, 1.0), random.between(1.0, 1.5)}}},
        1.0};
    const FlatlandConfiguration input{segment, {{0.0, 0.0}, facing(tilt)}};
    builder.attempt(input, [&] {
      const auto slope = riddersDerivative<double>(
          [&](double angle) {
            // Counterclockwise turns count as positive: away from the tilt, which leans to the right.
            return candidate.irradiance({segment, {{0.0, 0.0}, facing(tilt - angle)}});
          },
          kFirstTurn, tolerance * candidate.irradiance(input));
      const double actual = formulas.rotationalGradient(input);
      // Relative to irradiance: the gradient may vanish.
      const double size = candidate.irradiance(input);
      builder.add(std::abs(actual - slope.value) / size, slope.error / size, input,
                  Eigen::MatrixXd::Constant(1, 1, slope.value), Eigen::MatrixXd::Constant(1, 1, actual));
    });
  }
  return builder.finish();
}

}  // namespace irradiff
