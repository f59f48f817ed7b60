#include "derivatives/error_metric/valid_region.h"

#include "tests/error_metric/ellipse_quadrature.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace irradiff::error_metric_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2.0;

struct Case {
  Matrix2d hessian;
  ValidRegion region;

  /// What the error of integratedError is stated in.
  double scale() const {
    return hessian.operatorNorm() * region.half_axes.prod() * std::pow(region.half_axes.maxCoeff(), 2);
  }
};

/// Hessians of all signs, and ellipses whose axes are not theirs.
std::vector<Case> cases() {
  std::mt19937 random(20120806);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto angle = [&] { return std::numbers::pi * unit(random); };
  std::vector<Case> result;
  for (int i = 0; i < 100; ++i) {
    const double l1 = std::pow(10.0, 2.0 * unit(random));
    const double l2 = l1 * std::pow(10.0, 1.5 * unit(random));
    const Vector2d half_axes(std::pow(10.0, unit(random)), std::pow(10.0, unit(random)));
    const ValidRegion region{half_axes, Eigen::Rotation2Dd(angle()).toRotationMatrix()};
    for (const Vector2d& l : {Vector2d(l1, l2), Vector2d(-l1, -l2), Vector2d(l1, -l2), Vector2d(-l1, l2),
                              Vector2d(l1, 0.0), Vector2d(l1, l1), Vector2d(l1, -l1)}) {
      result.push_back({hessianOf(l(0), l(1), angle()), region});
      result.push_back({hessianOf(l(0), l(1), 0.0), {half_axes, Matrix2d::Identity()}});
    }
  }
  return result;
}

using Formula = std::function<double(const Matrix2d&, const ValidRegion&)>;

/// The largest difference from the quadrature, over what is allowed to the formula and the quadrature together.
double worstOverBound(const Formula& formula, const std::function<Matrix2d(const Matrix2d&)>& integrand) {
  double worst = 0.0;
  for (const Case& c : cases()) {
    const Quadrature expected = integrateHalfForm(integrand(c.hessian), c.region);
    const double bound = 16.0 * kRounding * c.scale() + expected.error_estimate;
    worst = std::max(worst, std::abs(formula(c.hessian, c.region) - expected.value) / bound);
  }
  return worst;
}

double exact(const Matrix2d& h, const ValidRegion& region) { return integratedError({h}, region); }
double bound(const Matrix2d& h, const ValidRegion& region) { return integratedErrorBound({h}, region); }
Matrix2d same(const Matrix2d& h) { return h; }

TEST(ValidRegion, TheErrorIsTheIntegralOfTheForm) {
  const double worst = worstOverBound(exact, same);
  std::cout << "integratedError: at most " << worst << " of its bound\n";
  EXPECT_LE(worst, 1.0);
}

TEST(ValidRegion, TheBoundIsTheIntegralOfTheAbsoluteHessian) {
  const double worst = worstOverBound(bound, absoluteHessian);
  std::cout << "integratedErrorBound: at most " << worst << " of its bound\n";
  EXPECT_LE(worst, 1.0);
}

TEST(ValidRegion, MistakesInTheIntegralsAreSeen) {
  // The bound is no integral of an indefinite form, nor the other way round.
  EXPECT_GT(worstOverBound(bound, same), 1e6);
  EXPECT_GT(worstOverBound(exact, absoluteHessian), 1e6);
  // The half of Eq. (5), and the weight of the radius in polar coordinates, pi/8 for pi/6.
  EXPECT_GT(worstOverBound([](const auto& h, const auto& r) { return 2.0 * exact(h, r); }, same), 1e6);
  EXPECT_GT(worstOverBound([](const auto& h, const auto& r) { return 4.0 / 3.0 * bound(h, r); }, absoluteHessian), 1e6);
  // Half-axes along the wrong axes.
  const auto exchanged = [](const Matrix2d& h, const ValidRegion& r) {
    return exact(h, {r.half_axes.reverse(), r.axes});
  };
  EXPECT_GT(worstOverBound(exchanged, same), 1e6);
}

TEST(ValidRegion, InTheHessiansAxesTheBoundIsBetweenTheErrorAndHalfPiTimesIt) {
  for (const Case& c : cases()) {
    const double slack = 32.0 * kRounding * c.scale();
    EXPECT_GE(bound(c.hessian, c.region), exact(c.hessian, c.region) - slack);
    if (!c.region.axes.isIdentity(0.0)) continue;
    EXPECT_LE(bound(c.hessian, c.region), 0.5 * std::numbers::pi * exact(c.hessian, c.region) + slack);
  }
  // In other axes no factor holds: an ellipse along a direction in which the form is zero.
  const ValidRegion along_zero{{1.0, 0.01}, Eigen::Rotation2Dd(0.25 * std::numbers::pi).toRotationMatrix()};
  EXPECT_GT(bound(hessianOf(1.0, -1.0, 0.0), along_zero), 10.0 * exact(hessianOf(1.0, -1.0, 0.0), along_zero));
}

TEST(ValidRegion, OfEqualTermsOfOppositeSignsTheBoundIsHalfPiTimesTheError) {
  for (const double ratio : {1.0, 4.0, 100.0}) {
    // |l1| a^2 = |l2| b^2.
    const ValidRegion region{{0.5, 0.5 * std::sqrt(ratio)}, Matrix2d::Identity()};
    const Matrix2d h = hessianOf(3.0 * ratio, -3.0, 0.0);
    const double quadrature = integrateHalfForm(h, region).value;
    EXPECT_NEAR(bound(h, region) / quadrature, 0.5 * std::numbers::pi, 32.0 * kRounding);
  }
}

TEST(ValidRegion, OfNoHessianTheErrorIsZero) {
  const ValidRegion region{{0.5, 2.0}, Matrix2d::Identity()};
  EXPECT_EQ(exact(Matrix2d::Zero(), region), 0.0);
  EXPECT_EQ(bound(Matrix2d::Zero(), region), 0.0);
}

}  // namespace
}  // namespace irradiff::error_metric_test
