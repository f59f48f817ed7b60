// Mistakes with Hessians and their axes.

#include "derivatives/error_metric/hessian_axes.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "experiments/io/scene_file.h"
#include "tests/checks/bad_twins.h"
#include "tests/checks/remembering_oracle.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>
#include <sstream>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 20120806;
constexpr double kDegree = std::numbers::pi / 180.0;

/// The direction in which the second derivative is largest in size, found by looking: an angle in degrees, in [0, 180).
double sharpestDirection(const Matrix2d& hessian) {
  const auto curvature = [&](double degrees) {
    const Vector2d v(std::cos(degrees * kDegree), std::sin(degrees * kDegree));
    return std::abs(v.dot(hessian * v));
  };
  double best = 0.0;
  for (double angle = 0.0; angle < 180.0; angle += 0.01) {
    if (curvature(angle) > curvature(best)) best = angle;
  }
  return best;
}

/// How far an axis is from that direction, in degrees; axes have no sign.
double axisError(const Matrix2d& hessian, const Vector2d& axis) {
  const double angle = std::atan2(axis(1), axis(0)) / kDegree - sharpestDirection(hessian);
  return std::abs(std::remainder(angle, 180.0));
}

/// The mistake: the eigenvalues are made positive, as the ellipse's radii need them, and the eigenvector is then
/// solved for from (H - |l1|) v = 0.
Vector2d axisFromAbsoluteEigenvalue(const Matrix2d& h) {
  const double middle = 0.5 * (h(0, 0) + h(1, 1));
  const double radius = std::hypot(0.5 * (h(0, 0) - h(1, 1)), h(0, 1));
  const double largest = std::max(std::abs(middle + radius), std::abs(middle - radius));
  return Vector2d(h(0, 1), largest - h(0, 0)).normalized();
}

Vector2d libraryAxis(const Matrix2d& h) { return hessianAxes({h}).axes.col(0); }

/// Tangential Hessians of irradiance: of random polygons, and of the hard cases that are negative definite and
/// indefinite.
std::vector<Matrix2d> hessians() {
  std::vector<Matrix2d> result;
  for (const Configuration& c : drawInputs(inputFamily("well-conditioned"), 40, kSeed)) {
    result.push_back(evaluatePolygon(c.polygon, 0, c.receiver).derivatives.tangential_hessian.value);
  }
  for (const char* name : {"negative_definite_hessian", "indefinite_hessian"}) {
    std::ifstream file(std::string("data/hard_cases/") + name + ".json");
    std::stringstream text;
    text << file.rdbuf();
    const Scene scene = parseScene(text.str());
    result.push_back(
        evaluatePolygon(scene.polygons.front(), 0, scene.receivers.front()).derivatives.tangential_hessian.value);
  }
  return result;
}

double worstAxisError(const std::function<Vector2d(const Matrix2d&)>& axis, bool of_positive_ones) {
  double worst = 0.0;
  for (const Matrix2d& h : hessians()) {
    const Vector2d eigenvalues = hessianAxes({h}).eigenvalues;
    // Of two eigenvalues of nearly one size either axis will do.
    if (std::abs(eigenvalues(1)) > 0.95 * std::abs(eigenvalues(0))) continue;
    if ((eigenvalues(0) > 0.0) != of_positive_ones) continue;
    worst = std::max(worst, axisError(h, axis(h)));
  }
  return worst;
}

TEST(Regressions, EigenvectorFromTheAbsoluteEigenvalue) {
  // Half a step of looking, and as much again where the maximum is flat.
  constexpr double kLooking = 0.1;
  EXPECT_LE(worstAxisError(libraryAxis, true), kLooking);
  EXPECT_LE(worstAxisError(libraryAxis, false), kLooking);
  // Right as long as the larger eigenvalue is positive, which is why nobody saw it.
  EXPECT_LE(worstAxisError(axisFromAbsoluteEigenvalue, true), kLooking);
  const double mistaken = worstAxisError(axisFromAbsoluteEigenvalue, false);
  std::cout << "axis from |lambda|: off by up to " << mistaken << " degrees\n";
  EXPECT_GT(mistaken, 10.0);
}

TEST(Regressions, HessianWithTheWrongSign) {
  const std::vector<Configuration> inputs = drawInputs(inputFamily("well-conditioned"), 1, kSeed);
  const Oracle enclosures = remembering(enclosureOracle());
  const auto check = [&](const Candidate& candidate) {
    return checkAgainst(enclosures, candidate, inputs, "well-conditioned", Allowance::uniform(2e-14, "the promise"));
  };
  for (const Verdict& verdict : check(productionCandidate())) EXPECT_TRUE(verdict.passed) << describe(verdict);
  for (const Quantity quantity : {Quantity::kHessian, Quantity::kTangentialHessian}) {
    for (const Verdict& verdict : check(multiplied(quantity, -1.0))) {
      EXPECT_EQ(verdict.passed, verdict.quantity != quantity) << describe(verdict);
      if (!verdict.passed) {
        EXPECT_THAT(verdict.likely_cause, HasSubstr("the sign is flipped"));
      }
    }
  }
}

}  // namespace
}  // namespace irradiff
