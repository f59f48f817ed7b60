#include "experiments/cache_3d/second_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace irradiff {
namespace {

ValidRegion regionOf(double first, double second, double angle) {
  Eigen::Matrix2d axes;
  axes << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return {{first, second}, axes};
}

QuadraticIrradiance quadratic() {
  QuadraticIrradiance q{2.0, {0.3, -0.7}, {}};
  q.hessian << 1.5, -0.4, -0.4, -0.8;
  return q;
}

double difference(const QuadraticIrradiance& a, const QuadraticIrradiance& b) {
  return std::abs(a.irradiance - b.irradiance) + (a.gradient - b.gradient).norm() + (a.hessian - b.hessian).norm();
}

TEST(SecondOrder, NearestToAQuadraticIsItself) {
  const QuadraticIrradiance exact = quadratic();
  const IrradianceAround around = [&](const Eigen::Vector2d& step) { return exact.at(step); };
  for (const ValidRegion& region : {regionOf(0.2, 0.2, 0.0), regionOf(0.05, 0.4, 0.7), regionOf(1e-4, 2e-4, 2.0)}) {
    const QuadraticIrradiance start{2.0, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
    // Rounding of irradiance over the square of the half-axis; 1e-13, 3e-12, 4e-8 here.
    const double tolerance = 1e-15 * 20.0 / (region.half_axes(0) * region.half_axes(0)) + 1e-12;
    EXPECT_LT(difference(nearestQuadratic(start, around, region), exact), tolerance);
    // Bad twin: axes taken for those of the frame.
    if (region.axes(0, 1) != 0.0) {
      QuadraticIrradiance turned = exact;
      turned.hessian = region.axes.transpose() * exact.hessian * region.axes;
      EXPECT_GT(difference(turned, exact), tolerance);
    }
  }
}

TEST(SecondOrder, IsFlatterThanTheTaylorSeriesBesideAPenumbra) {
  // A penumbra begins a step away: all derivatives at the record are 0.
  const IrradianceAround around = [](const Eigen::Vector2d& step) {
    const double into = std::max(0.0, step(0) - 0.1);
    return 1.0 - into * into;
  };
  const QuadraticIrradiance taylor{1.0, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  const ValidRegion region = regionOf(0.5, 0.5, 0.0);
  const QuadraticIrradiance nearest = nearestQuadratic(taylor, around, region);
  EXPECT_LT(nearest.gradient(0), -0.01);
  EXPECT_LT(nearest.hessian(0, 0), -0.1);
  EXPECT_NEAR(nearest.gradient(1), 0.0, 1e-12);
  // Squared errors by midpoints of squares, with the weight of interpolation.
  const auto weightedSquares = [&](const QuadraticIrradiance& extrapolation) {
    double sum = 0.0;
    for (double x = -0.495; x < 0.5; x += 0.01) {
      for (double y = -0.495; y < 0.5; y += 0.01) {
        const Eigen::Vector2d step(x, y);
        const double error = *around(step) - extrapolation.at(step);
        sum += std::max(0.0, 1.0 - step.norm() / 0.5) * error * error;
      }
    }
    return sum;
  };
  EXPECT_LT(weightedSquares(nearest), 0.5 * weightedSquares(taylor));  // 0.27
  // Bad twin: a little aside of the nearest is farther away.
  QuadraticIrradiance aside = nearest;
  aside.gradient(0) += 0.05;
  EXPECT_GT(weightedSquares(aside), weightedSquares(nearest));
  aside.gradient(0) -= 0.1;
  EXPECT_GT(weightedSquares(aside), weightedSquares(nearest));
}

TEST(SecondOrder, StaysWhereReceiversDoNotTell) {
  const QuadraticIrradiance start = quadratic();
  const IrradianceAround nowhere = [](const Eigen::Vector2d&) { return std::optional<double>(); };
  EXPECT_EQ(difference(nearestQuadratic(start, nowhere, regionOf(0.1, 0.2, 0.0)), start), 0.0);
  const IrradianceAround line = [](const Eigen::Vector2d& step) {
    return std::abs(step(1)) < 1e-9 ? std::optional<double>(5.0) : std::nullopt;
  };
  EXPECT_EQ(difference(nearestQuadratic(start, line, regionOf(0.1, 0.2, 0.0)), start), 0.0);
}

TEST(SecondOrder, ErrorsAreDifferencesAndZeroWhereThereIsNoReceiver) {
  const QuadraticIrradiance zero;
  const IrradianceAround half = [](const Eigen::Vector2d& step) {
    return step(0) < 0.0 ? std::nullopt : std::optional<double>(-3.0 * step.norm());
  };
  const std::vector<double> distances{0.5, 2.0};
  const ErrorProfile profile = errorsOf(zero, half, distances, 4);
  EXPECT_EQ(profile.errors[0], 1.5f);
  EXPECT_EQ(profile.errors[1], 6.0f);
  EXPECT_EQ(profile.errors[4], 0.0f);
  EXPECT_EQ(profile.distances, distances);
}

}  // namespace
}  // namespace irradiff
