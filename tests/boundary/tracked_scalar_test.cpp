// The instrument itself: counts that are known by hand.

#include "tests/boundary/tracked_scalar.h"

#include <gtest/gtest.h>

namespace irradiff {
namespace {

double relative(const Tracked& result) { return result.worstError() / std::abs(static_cast<double>(result.value())); }

TEST(TrackedScalar, CountsOneRoundingAnOperation) {
  const ErrorTape tape;
  const Tracked x = Tracked::input(3.0L);
  const Tracked y = Tracked::input(7.0L);
  EXPECT_EQ(relative(x + y), 1.0);
  EXPECT_EQ(relative(x - y), 1.0);
  EXPECT_EQ(relative(x * y), 1.0);
  EXPECT_EQ(relative(x / y), 1.0);
  EXPECT_EQ(relative(sqrt(x)), 1.0);
  EXPECT_EQ(relative(sin(x)), 2.0);
  EXPECT_EQ(relative(atan2(x, y)), 2.0);
  EXPECT_EQ(relative((x + y) * x), 2.0);
  EXPECT_EQ(relative(Tracked::input(5.0L, 2.5)), 2.5);
}

TEST(TrackedScalar, PropagatesByTheDerivative) {
  const ErrorTape tape;
  const Tracked x = Tracked::input(3.0L, 1.0);
  const Tracked y = Tracked::input(4.0L, 1.0);
  // x^2 + y^2: 2 in each square and 1 in each product, 1 in the sum; the root halves them and adds its own.
  EXPECT_DOUBLE_EQ(relative(x * x + y * y), 4.0);
  EXPECT_DOUBLE_EQ(relative(sqrt(x * x + y * y)), 3.0);
  EXPECT_DOUBLE_EQ(sin(x).worstError(), 3.0 * std::abs(std::cos(3.0)) + 2.0 * std::sin(3.0));
  EXPECT_DOUBLE_EQ(cos(x).worstError(), 3.0 * std::sin(3.0) + 2.0 * std::abs(std::cos(3.0)));
  // d atan2(y, x) = (x dy - y dx)/(x^2 + y^2), with dx = x u and dy = y u of either sign.
  EXPECT_DOUBLE_EQ(atan2(y, x).worstError(), 24.0 / 25.0 + 2.0 * std::atan2(4.0, 3.0));
}

TEST(TrackedScalar, OneRoundingThatEntersTwiceMayCancelOrDouble) {
  const ErrorTape tape;
  const Tracked x = Tracked::input(3.0L) * Tracked::input(5.0L);
  EXPECT_DOUBLE_EQ(relative(x / x), 1.0);
  EXPECT_DOUBLE_EQ(relative(x * x), 3.0);
  // Cancellation: 15 u from x and nothing from the small difference but its own rounding.
  EXPECT_DOUBLE_EQ((x - Tracked::input(14.0L)).worstError(), 16.0);
}

TEST(TrackedScalar, KnowsWhatIsExact) {
  const ErrorTape tape;
  const Tracked x = Tracked::input(3.0L);
  EXPECT_EQ((x * lift<Tracked>(0.25)).worstError(), 0.0);
  EXPECT_EQ((x / lift<Tracked>(2.0)).worstError(), 0.0);
  EXPECT_EQ((x + lift<Tracked>(0.0)).worstError(), 0.0);
  EXPECT_EQ((-x).worstError(), 0.0);
  EXPECT_EQ(relative(x * lift<Tracked>(3.0)), 1.0);
  EXPECT_EQ(relative(x * (lift<Tracked>(1.0) * lift<Tracked>(0.5))), 0.0);
  EXPECT_EQ((x + (lift<Tracked>(0.5) - lift<Tracked>(0.5))).worstError(), 0.0);
  // An input is not known to be a power of two.
  EXPECT_EQ(relative(x * Tracked::input(2.0L)), 1.0);
}

TEST(TrackedScalar, WideArithmeticRoundsOnceOnTheWayOut) {
  const ErrorTape tape;
  const WideTracked x = WideTracked::input(3.0L);
  const WideTracked y = (x * x + x) / (x - WideTracked(1.0));
  EXPECT_EQ(y.worstError(), 0.0);
  EXPECT_EQ(relative(static_cast<Tracked>(y)), 1.0);
  // What was rounded before stays so.
  EXPECT_DOUBLE_EQ(static_cast<Tracked>(WideTracked(Tracked::input(3.0L, 2.0)) * x).worstError(), 3.0 * 9.0);
  EXPECT_TRUE((std::is_same_v<Wide<Tracked>, WideTracked>));
  EXPECT_TRUE(kIsMachinePrecision<Tracked>);
  EXPECT_FALSE(kIsMachinePrecision<TrackedClosedForms>);
}

}  // namespace
}  // namespace irradiff
