#include "verification/enclosure/ball.h"

#include "verification/enclosure/ball_vector.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace irradiff {
namespace {

TEST(Ball, HoldsADoubleExactlyAndADecimalWithItsRounding) {
  EXPECT_TRUE(Ball(0.1).isExact());
  const Ball tenth = Ball::fromDecimal("0.1");
  EXPECT_FALSE(tenth.isExact());
  EXPECT_TRUE((tenth * Ball(10)).contains(Ball(1)));
  // 0.1 the double is not 0.1 the decimal.
  EXPECT_FALSE(tenth.overlaps(Ball(0.1)));
  EXPECT_TRUE(Ball::fromDecimal("0.1 +/- 1e-17").contains(Ball(0.1)));
}

TEST(Ball, NamesTextThatIsNoNumber) {
  try {
    Ball::fromDecimal("1.2.3");
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("1.2.3"), std::string::npos);
  }
}

TEST(Ball, ComparisonsAreCertainOrFalse) {
  const Ball around_one = Ball::fromDecimal("1 +/- 0.5");
  EXPECT_TRUE(around_one < Ball(2));
  EXPECT_FALSE(around_one < Ball(1));
  EXPECT_FALSE(around_one >= Ball(1));
  EXPECT_FALSE(around_one == Ball(1));
  EXPECT_FALSE(around_one != Ball(1));
  EXPECT_FALSE(around_one == around_one);
  EXPECT_TRUE(around_one != Ball(2));
  EXPECT_TRUE(Ball(1) == Ball(1.0));
}

TEST(Ball, WhatHasNoResultIsNotFinite) {
  EXPECT_FALSE((Ball(1) / Ball::fromDecimal("0 +/- 1e-30")).isFinite());
  EXPECT_FALSE(sqrt(Ball(-1)).isFinite());
  EXPECT_FALSE(acos(Ball(2)).isFinite());
  EXPECT_FALSE(Ball(std::numeric_limits<double>::quiet_NaN()).isFinite());
  EXPECT_TRUE(sqrt(Ball(0)).isFinite());
}

TEST(Ball, FunctionsEncloseTheirIdentities) {
  const Ball x = Ball(0.3);
  EXPECT_TRUE((sin(x) * sin(x) + cos(x) * cos(x)).contains(Ball(1)));
  EXPECT_TRUE((Ball(4) * atan(Ball(1))).overlaps(Ball::pi()));
  EXPECT_TRUE(acos(cos(x)).contains(x));
  EXPECT_TRUE(atan2(sin(x), cos(x)).contains(x));
  EXPECT_TRUE((sqrt(Ball(2)) * sqrt(Ball(2))).contains(Ball(2)));
  EXPECT_TRUE(abs(Ball(-3)) == Ball(3));
}

TEST(Ball, AngleAcrossTheCutKeepsBothSides) {
  const Ball angle = atan2(Ball::fromDecimal("0 +/- 1e-30"), Ball(-1));
  EXPECT_TRUE(angle.contains(Ball(3.0)));
  EXPECT_TRUE(angle.contains(Ball(-3.0)));
}

TEST(Ball, SmallerAndLargerHoldForEveryChoice) {
  const Ball wide = Ball::fromDecimal("1 +/- 0.5");
  EXPECT_TRUE(min(wide, Ball(1)).contains(Ball(0.5)));
  EXPECT_TRUE(min(wide, Ball(1)).contains(Ball(1)));
  EXPECT_TRUE(max(wide, Ball(1)).contains(Ball(1.5)));
  EXPECT_TRUE(max(wide, Ball(1)).contains(Ball(1)));
}

TEST(Ball, PrecisionEndsWithItsScope) {
  const slong before = WorkingPrecision::bits();
  {
    const WorkingPrecision scope(1000);
    EXPECT_EQ(WorkingPrecision::bits(), 1000);
    EXPECT_GT(Ball::pi().digits(), 290);
  }
  EXPECT_EQ(WorkingPrecision::bits(), before);
  EXPECT_LT(Ball::pi().digits(), 90);
  EXPECT_THROW(WorkingPrecision(1), std::invalid_argument);
}

TEST(Ball, CancellationShowsInTheRadius) {
  const WorkingPrecision scope(53);
  const Ball third = Ball(1) / Ball(3);
  const Ball difference = (third + Ball(1e10)) - Ball(1e10);
  EXPECT_TRUE(difference.overlaps(third));
  EXPECT_LT(difference.digits(), 7);
  EXPECT_GT(third.digits(), 15);
}

TEST(Ball, DecimalsReadBack) {
  const Ball pi = Ball::pi();
  EXPECT_EQ(pi.midpointToDecimal(20), "3.1415926535897932385");
  EXPECT_TRUE(Ball::fromDecimal(pi.toDecimal(30).substr(1, pi.toDecimal(30).size() - 2)).contains(pi));
  EXPECT_EQ(pi.toDouble(), 3.14159265358979323846);
}

TEST(Ball, IsAScalarOfEigenMatrices) {
  BallMatrix a = BallMatrix::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) a(i, i) = Ball(static_cast<int>(i) + 1);
  const BallVector v = exactly(Eigen::Vector3d(1, 2, 3));
  const BallVector product = a * v + v * Ball(2);
  EXPECT_TRUE(product(0) == Ball(3));
  EXPECT_TRUE(product(1) == Ball(8));
  EXPECT_TRUE(product(2) == Ball(15));
}

}  // namespace
}  // namespace irradiff
