#include "derivatives/error_metric/hessian_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kRounding = std::numeric_limits<double>::epsilon();

Matrix2d symmetric(double a, double b, double c) {
  Matrix2d h;
  h << a, b, b, c;
  return h;
}

HessianAxes axesOf(const Matrix2d& h) { return hessianAxes({h}); }

/// The definition: H = A diag A^T, A a rotation, the larger eigenvalue first.
void expectDecomposition(const Matrix2d& h) {
  const HessianAxes axes = axesOf(h);
  SCOPED_TRACE(testing::Message() << "H = " << h(0, 0) << ' ' << h(0, 1) << ' ' << h(1, 1));
  const double size = h.cwiseAbs().maxCoeff();
  const Matrix2d product = axes.axes * axes.eigenvalues.asDiagonal() * axes.axes.transpose();
  EXPECT_LE((product - h).cwiseAbs().maxCoeff(), 4.0 * kRounding * size);
  EXPECT_LE((axes.axes.transpose() * axes.axes - Matrix2d::Identity()).cwiseAbs().maxCoeff(), 4.0 * kRounding);
  EXPECT_NEAR(axes.axes.determinant(), 1.0, 4.0 * kRounding);
  EXPECT_GE(std::abs(axes.eigenvalues(0)), std::abs(axes.eigenvalues(1)));
}

TEST(HessianAxes, DecomposeEveryKindOfHessian) {
  std::mt19937 random(20120806);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Matrix2d any = symmetric(entry(random), entry(random), entry(random));
    const Matrix2d square = any * any.transpose();
    expectDecomposition(any);
    expectDecomposition(symmetric(square(0, 0), square(0, 1), square(1, 1)));
    expectDecomposition(symmetric(-square(0, 0), -square(0, 1), -square(1, 1)));
    // Almost repeated, and almost singular.
    expectDecomposition(symmetric(1.0, 1e-9 * entry(random), 1.0 + 1e-9 * entry(random)));
    const double slope = entry(random);
    expectDecomposition(symmetric(1.0, slope, slope * slope));
  }
}

TEST(HessianAxes, AreThoseOfTheFrameWhereTheHessianIsDiagonal) {
  for (const Vector2d& diagonal : {Vector2d(3.0, 1.0), Vector2d(3.0, -1.0), Vector2d(3.0, 0.0)}) {
    EXPECT_EQ(axesOf(diagonal.asDiagonal()).axes, Matrix2d::Identity());
    EXPECT_EQ(axesOf(diagonal.asDiagonal()).eigenvalues, diagonal);
    const HessianAxes exchanged = axesOf(diagonal.reverse().asDiagonal());
    EXPECT_EQ(exchanged.axes.col(0), Vector2d(0.0, 1.0));
    EXPECT_EQ(exchanged.eigenvalues, diagonal);
    const HessianAxes negative = axesOf((-diagonal).asDiagonal());
    EXPECT_EQ(negative.axes.col(0).cwiseAbs(), Vector2d(1.0, 0.0));
    EXPECT_EQ(negative.eigenvalues, -diagonal);
  }
}

TEST(HessianAxes, AreTheFrameWhereEigenvaluesRepeatAndWhereAllIsZero) {
  for (const double value : {2.0, 0.0, 1e-320}) {
    EXPECT_EQ(axesOf(value * Matrix2d::Identity()).axes, Matrix2d::Identity());
    EXPECT_EQ(axesOf(value * Matrix2d::Identity()).eigenvalues, Vector2d(value, value));
  }
  expectDecomposition(-2.0 * Matrix2d::Identity());
  // Opposite eigenvalues of one size.
  expectDecomposition(symmetric(0.0, 1.0, 0.0));
  expectDecomposition(symmetric(1.0, 0.0, -1.0));
}

TEST(HessianAxes, DoNotDependOnTheUnitOfLength) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const Matrix2d h = symmetric(entry(random), entry(random), entry(random));
    const HessianAxes axes = axesOf(h);
    for (const int exponent : {-900, -60, 60, 900}) {
      const HessianAxes scaled = axesOf(std::ldexp(1.0, exponent) * h);
      EXPECT_EQ(scaled.axes, axes.axes);
      EXPECT_EQ(scaled.eigenvalues, Vector2d(std::ldexp(1.0, exponent) * axes.eigenvalues));
    }
  }
  // Squares of these are beyond double.
  expectDecomposition(symmetric(1e308, 3e307, -1e307));
  expectDecomposition(symmetric(1e-300, 2e-301, -3e-300));
}

}  // namespace
}  // namespace irradiff
