// Mistakes with lengths: results that depend on their unit.

#include "tests/checks/bad_twins.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle_check.h"

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace irradiff {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 20120806;
constexpr double kTolerance = 1e-12;

/// The mistake: edges that are seen "as good as" radially are skipped where |r x r'| < 1e-6, which is an area in the
/// scene's unit squared. Right but for that.
Vector3d gradientWithAbsoluteThreshold(const Configuration& c) {
  Vector3d sum = Vector3d::Zero();
  const std::vector<Vector3d>& v = c.polygon.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vector3d r = v[i] - c.receiver.position;
    const Vector3d e = v[(i + 1) % v.size()] - v[i];
    const Vector3d moment = r.cross(e);
    if (moment.norm() < 1e-6) continue;
    sum += moment *
           boost::math::quadrature::gauss<double, 40>::integrate(
               [&](double t) { return c.receiver.normal.dot(r + t * e) / std::pow((r + t * e).norm(), 4); }, 0.0, 1.0);
  }
  return sum / std::numbers::pi;
}

/// The same scenes in a unit that is `scale` times as long.
std::vector<Configuration> inUnitOf(double scale) {
  std::vector<Configuration> inputs = drawInputs(inputFamily("well-conditioned"), 20, kSeed);
  for (Configuration& input : inputs) {
    for (Vector3d& vertex : input.polygon.vertices) vertex /= scale;
    input.receiver.position /= scale;
  }
  return inputs;
}

/// Against values at 200 digits.
Verdict judged(const Candidate& candidate, double unit) {
  Candidate gradient{candidate.name};
  gradient.gradient = candidate.gradient;
  return checkAgainst(multiprecisionOracle(), gradient, inUnitOf(unit), "well-conditioned, in another unit",
                      Allowance::uniform(kTolerance, "40 points of Gauss leave less than this"))
      .front();
}

TEST(Regressions, AbsoluteThresholdThatDependsOnTheUnitOfLength) {
  Candidate mistaken{"absolute threshold"};
  mistaken.gradient = gradientWithAbsoluteThreshold;
  // Metres, millimetres, kilometres.
  for (const double unit : {1.0, 1e-3, 1e3}) {
    const Verdict library = judged(productionCandidate(), unit);
    EXPECT_TRUE(library.passed) << describe(library);
    const Verdict verdict = judged(mistaken, unit);
    EXPECT_EQ(verdict.passed, unit <= 1.0) << describe(verdict);
  }
}

}  // namespace
}  // namespace irradiff
