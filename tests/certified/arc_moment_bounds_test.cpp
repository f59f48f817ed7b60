#include "verification/certified/arc_moment_bounds.h"

#include "verification/certified/ball_rounding.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <array>

namespace irradiff {
namespace {

using Words = DoubleWord<double>;

template <class Scalar>
std::array<Scalar, 5> inARow(const ArcMoments<Scalar>& m) {
  return {m.aa, m.ab, m.aaaa, m.aaab, m.aabb};
}

template <class T>
class ArcMomentBounds : public testing::Test {};
using Scalars = testing::Types<double, long double, Words>;
TYPED_TEST_SUITE(ArcMomentBounds, Scalars);

TYPED_TEST(ArcMomentBounds, HoldTheClosedForms) {
  const WorkingPrecision precision(2048);
  for (std::size_t i = 0; i < 1000; ++i) {
    KeyedRandom random(1, "arc moments", i);
    const double middle = i % 5 == 0   ? random.decade(-9.0, 0.3)
                          : i % 5 == 1 ? random.between(0.9999, 1.0001)
                                       : random.between(1e-3, 2.0);
    const double error = i % 3 == 0 ? 0.0 : middle * random.decade(-30.0, -5.0);
    const auto moments = inARow(arcMoments(RunningBound<TypeParam>(TypeParam(middle), error)));
    const Ball angle = Ball(middle) + Ball(error) * Ball(random.between(-1.0, 1.0));
    const auto exact = inARow(arcMoments(angle));
    for (std::size_t k = 0; k < 5; ++k) {
      const Ball enclosure = enclosureOf(moments[k]);
      EXPECT_TRUE(enclosure.overlaps(exact[k])) << k << " at " << middle;
      // The reference is sharper by far, so that overlapping means holding.
      EXPECT_TRUE(exact[k].radius() < enclosure.radius() * Ball(1e-3)) << k << " at " << middle;
      // The bad twin: a coefficient off by a thousand roundings.
      const double shift = 1e3 * moments[k].error();
      EXPECT_FALSE((enclosure + Ball(shift)).overlaps(exact[k])) << k << " at " << middle;
      // Sharp too, where the angle is exact.
      if (error == 0.0) {
        EXPECT_LE(moments[k].error(), 512.0 * Rounding<TypeParam>::kProduct) << k << " at " << middle;
      }
    }
  }
}

TEST(ArcMomentSeries, IsPositiveAndNoSteeperThanAssumed) {
  const WorkingPrecision precision(512);
  constexpr std::size_t kTerms = 60;
  const auto series = detail::arcMomentSeries<Ball, kTerms>();
  for (const auto& coefficients : {series.aa, series.ab, series.aaaa, series.aaab, series.aabb}) {
    Ball value;
    Ball slope;
    Ball power(1);
    for (std::size_t k = 0; k < kTerms; ++k) {
      EXPECT_TRUE(coefficients[k] > Ball(0)) << k;
      value += coefficients[k] * power;
      if (k + 1 < kTerms) slope += Ball(static_cast<double>(k + 1)) * coefficients[k + 1] * power;
      power *= Ball(BoundedArcMomentSeries<double>::kLongestSquare);
    }
    EXPECT_TRUE(slope < value * Ball(BoundedArcMomentSeries<double>::kSlope)) << (slope / value).toDecimal(5);
  }
}

TEST(ArcMomentSeries, LeavesOutLessThanItsRoundings) {
  for (const auto* series : {&boundedArcMomentSeries<double>().aabb, &boundedArcMomentSeries<double>().aa}) {
    EXPECT_LT(series->tail, 0x1p-53);
    EXPECT_LT(series->short_tail, 0x1p-53);
    EXPECT_GT(series->tail, 0.0);
  }
  EXPECT_LT(boundedArcMomentSeries<Words>().aabb.tail, 0x1p-100);
}

}  // namespace
}  // namespace irradiff
