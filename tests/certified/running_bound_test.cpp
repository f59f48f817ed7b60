#include "verification/certified/running_bound.h"

#include "verification/certified/ball_rounding.h"
#include "verification/checks/random.h"
#include "verification/enclosure/ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace irradiff {
namespace {

using Words = DoubleWord<double>;

template <class T>
class RunningBoundTest : public testing::Test {
 public:
  /// A number with an error of up to a thousandth of its size, often none, and some number within it.
  struct Draw {
    RunningBound<T> bound;
    Ball exact;
  };

  Draw draw(KeyedRandom& random) {
    const double size = random.decade(-3.0, 3.0) * (random.below(2) == 0 ? 1.0 : -1.0);
    T value = T(size);
    if constexpr (std::same_as<T, Words>) value = twoSum(size, std::ldexp(random.between(-1.0, 1.0), -54) * size);
    if constexpr (std::same_as<T, long double>) value += static_cast<long double>(size) * random.unit() * 0x1p-55L;
    const double error = random.below(3) == 0 ? 0.0 : std::abs(size) * random.decade(-32.0, -3.0);
    const RunningBound<T> bound(value, error);
    const Ball midpoint = enclosureOf(RunningBound<T>(value, 0.0));
    return {bound, midpoint + Ball(error) * Ball(random.between(-1.0, 1.0))};
  }

  static bool holds(const RunningBound<T>& bound, const Ball& exact) {
    return enclosureOf(bound).contains(exact.midpoint()) || enclosureOf(bound).overlaps(exact);
  }
};

using Scalars = testing::Types<double, long double, Words>;
TYPED_TEST_SUITE(RunningBoundTest, Scalars);

TYPED_TEST(RunningBoundTest, HoldsForQuotientsOfTinyNumbers) {
  const WorkingPrecision precision(2048);
  for (std::size_t i = 0; i < 2'000; ++i) {
    KeyedRandom random(1, "tiny running bound", i);
    auto a = this->draw(random);
    auto b = this->draw(random);
    // Exact scaling, but for what a double word loses of its lower half.
    const double scale = std::ldexp(1.0, -900 - static_cast<int>(random.below(90)));
    const auto shrink = [scale](auto& draw) {
      const double size = static_cast<double>(draw.bound.value()) * scale;
      draw.bound = RunningBound<TypeParam>(TypeParam(size), draw.bound.rawError() == 0.0 ? 0.0 : 0x1p-1060);
      draw.exact = Ball(size) + Ball(draw.bound.rawError());
    };
    shrink(a);
    shrink(b);
    EXPECT_TRUE(this->holds(a.bound / b.bound, a.exact / b.exact)) << i;
  }
}

TYPED_TEST(RunningBoundTest, HoldsForEveryOperation) {
  const WorkingPrecision precision(512);
  for (std::size_t i = 0; i < 20'000; ++i) {
    KeyedRandom random(1, "running bound", i);
    const auto a = this->draw(random);
    const auto b = this->draw(random);
    EXPECT_TRUE(this->holds(a.bound + b.bound, a.exact + b.exact)) << i;
    EXPECT_TRUE(this->holds(a.bound - b.bound, a.exact - b.exact)) << i;
    EXPECT_TRUE(this->holds(a.bound * b.bound, a.exact * b.exact)) << i;
    EXPECT_TRUE(this->holds(a.bound / b.bound, a.exact / b.exact)) << i;
    EXPECT_TRUE(this->holds(abs(a.bound), abs(a.exact))) << i;
    EXPECT_TRUE(this->holds(sqrt(abs(a.bound)), sqrt(abs(a.exact)))) << i;
    EXPECT_TRUE(this->holds(cos(a.bound), cos(a.exact))) << i;
    EXPECT_TRUE(this->holds(atan2(a.bound, b.bound), atan2(a.exact, b.exact))) << i;
  }
}

TYPED_TEST(RunningBoundTest, IsNoMoreThanAFewRoundingsWide) {
  KeyedRandom random(2, "width", 0);
  for (int i = 0; i < 1000; ++i) {
    RunningBound<TypeParam> a = this->draw(random).bound;
    RunningBound<TypeParam> b = this->draw(random).bound;
    a = RunningBound<TypeParam>(a.value(), 0.0);
    b = RunningBound<TypeParam>(b.value(), 0.0);
    const double u = Rounding<TypeParam>::kProduct;
    for (const auto& result : {a * b, a / b, sqrt(abs(a))}) {
      const double size = Rounding<TypeParam>::magnitude(result.value());
      EXPECT_GT(result.error(), 0.0);
      EXPECT_LE(result.error(), 8.0 * u * size + 1e-300);
    }
  }
}

TYPED_TEST(RunningBoundTest, BoundsThatLackTheRoundingAreRefuted) {
  // The bad twin: products whose own rounding is left out.
  const WorkingPrecision precision(512);
  std::size_t refuted = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    KeyedRandom random(3, "twin", i);
    const auto a = this->draw(random);
    const auto b = this->draw(random);
    const auto product = RunningBound<TypeParam>(a.bound.value(), 0.0) * RunningBound<TypeParam>(b.bound.value(), 0.0);
    const Ball exact = enclosureOf(RunningBound<TypeParam>(a.bound.value(), 0.0)) *
                       enclosureOf(RunningBound<TypeParam>(b.bound.value(), 0.0));
    if (!this->holds(RunningBound<TypeParam>(product.value(), 0.0), exact)) ++refuted;
  }
  EXPECT_GT(refuted, 50U);
}

TYPED_TEST(RunningBoundTest, ComparesOnlyWhatIsCertain) {
  using Bound = RunningBound<TypeParam>;
  const Bound one(TypeParam(1.0), 0.25);
  const Bound near(TypeParam(1.25), 0.25);
  const Bound far(TypeParam(2.0), 0.25);
  EXPECT_TRUE(one < far);
  EXPECT_TRUE(far > one);
  EXPECT_FALSE(one < near);
  EXPECT_FALSE(one > near);
  EXPECT_FALSE(one <= near);
  EXPECT_FALSE(near == near);
  EXPECT_TRUE(Bound(2.0) == Bound(2.0));
  EXPECT_TRUE(Bound(2.0) <= Bound(2.0));
  EXPECT_FALSE(Bound(2.0) < Bound(2.0));
}

TYPED_TEST(RunningBoundTest, SaysWhereASignIsNotKnown) {
  using Bound = RunningBound<TypeParam>;
  EXPECT_TRUE(isPositive(Bound(TypeParam(1.0), 0.5)));
  EXPECT_FALSE(isPositive(Bound(TypeParam(-1.0), 0.5)));
  EXPECT_FALSE(isPositive(Bound(0.0)));
  EXPECT_THROW(isPositive(Bound(TypeParam(0.25), 0.5)), Undecided);
  EXPECT_THROW(isPositive(Bound(TypeParam(0.0), 1e-300)), Undecided);
  EXPECT_THROW(isPositive(Bound::unbounded()), Undecided);
  const Bound either = withSignOf(Bound(TypeParam(3.0), 0.0), Bound(TypeParam(0.0), 1e-9));
  EXPECT_GE(either.error(), 3.0);
}

TYPED_TEST(RunningBoundTest, KnowsNothingWhereNothingIsKnown) {
  using Bound = RunningBound<TypeParam>;
  EXPECT_FALSE((Bound(1.0) / Bound(TypeParam(0.25), 0.5)).isFinite());
  EXPECT_FALSE((Bound(1.0) / Bound(0.0)).isFinite());
  // Across the cut the angle may be either end.
  const Bound across = atan2(Bound(TypeParam(0.0), 1e-20), Bound(-1.0));
  EXPECT_TRUE(!across.isFinite() || across.error() >= 3.14);
  EXPECT_TRUE(atan2(Bound(0.0), Bound(-1.0)).isFinite());
}

}  // namespace
}  // namespace irradiff
