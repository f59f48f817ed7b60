#include "derivatives/scene/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace irradiff {
namespace {

using Eigen::Vector2d;

int naiveOrientation(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double determinant = (a.x() - c.x()) * (b.y() - c.y()) - (a.y() - c.y()) * (b.x() - c.x());
  return (determinant > 0) - (determinant < 0);
}

TEST(Orientation, TellsLeftRightAndOnTheLine) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, -1}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {7, 0}), 0);
}

// Kettner et al., "Classroom examples of robustness problems in geometric computations" (2008): a point moved in steps
// of one ulp near the line through (12, 12) and (24, 24). Its side is the sign of y - x.
TEST(Orientation, IsExactWhereTheNaiveDeterminantIsNot) {
  constexpr double kUlp = 0x1p-53;
  int naive_errors = 0;
  for (int i = 0; i < 256; ++i) {
    for (int j = 0; j < 256; ++j) {
      const Vector2d point(0.5 + i * kUlp, 0.5 + j * kUlp);
      const int expected = (point.y() > point.x()) - (point.y() < point.x());
      ASSERT_EQ(orientation({12, 12}, {24, 24}, point), expected) << i << " " << j;
      naive_errors += naiveOrientation({12, 12}, {24, 24}, point) != expected;
    }
  }
  EXPECT_GT(naive_errors, 0) << "the inputs are too easy: they tell no exact predicate from a naive one";
}

// Integers below 2^53 are doubles and their determinant fits in 128 bits.
TEST(Orientation, AgreesWithIntegerArithmeticOnNearlyCollinearPoints) {
  __extension__ using Wide = __int128;
  std::mt19937_64 random(20240611);
  std::uniform_int_distribution<std::int64_t> coordinate(-(std::int64_t{1} << 50), std::int64_t{1} << 50);
  std::uniform_int_distribution<std::int64_t> nudge(-1, 1);
  int naive_errors = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const std::int64_t ax = coordinate(random), ay = coordinate(random);
    const std::int64_t bx = ax + coordinate(random) / 4, by = ay + coordinate(random) / 4;
    const std::int64_t cx = ax + (bx - ax) / 3 + nudge(random), cy = ay + (by - ay) / 3 + nudge(random);
    const Wide determinant = Wide{ax - cx} * Wide{by - cy} - Wide{ay - cy} * Wide{bx - cx};
    const int expected = (determinant > 0) - (determinant < 0);
    const auto point = [](std::int64_t x, std::int64_t y) {
      return Vector2d(std::ldexp(static_cast<double>(x), -200), std::ldexp(static_cast<double>(y), 300));
    };
    const Vector2d a = point(ax, ay), b = point(bx, by), c = point(cx, cy);
    ASSERT_EQ(orientation(a, b, c), expected) << trial;
    ASSERT_EQ(orientation(b, a, c), -expected) << trial;
    naive_errors += naiveOrientation(a, b, c) != expected;
  }
  EXPECT_GT(naive_errors, 0) << "the inputs are too easy: they tell no exact predicate from a naive one";
}

}  // namespace
}  // namespace irradiff
