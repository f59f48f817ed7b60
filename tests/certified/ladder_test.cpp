#include "verification/certified/ladder.h"

#include "verification/certified/rounded_evaluation.h"
#include "verification/enclosure/undecided.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace irradiff {
namespace {

/// Every quantity is 1 in the max norm, and exact but for irradiance.
CertifiedValue<3> ones(double error) {
  CertifiedValue<3> value = noLight<3>();
  value.rounded.irradiance.value = RunningBound<double>(1.0, error);
  value.rounded.gradient.value(2) = RunningBound<double>(1.0);
  value.rounded.hessian.value(2, 2) = RunningBound<double>(1.0);
  value.rounded.tangential_hessian.value(0, 0) = RunningBound<double>(1.0);
  return value;
}

/// A source of irradiance 1 whose error is `errors` at the rungs, and exact derivatives.
LadderSource<3> sourceWithErrors(double in_double, double in_extended, double in_balls, std::vector<Rung>* visited) {
  LadderSource<3> source;
  source.evaluate = [=](const LadderStep& step) {
    if (visited != nullptr) visited->push_back(step.rung);
    const double error = step.rung == Rung::kDouble     ? in_double
                         : step.rung == Rung::kExtended ? in_extended
                                                        : std::ldexp(in_balls, -static_cast<int>(step.bits));
    return ones(error);
  };
  return source;
}

TEST(Ladder, StaysInDoubleWhereThatIsEnough) {
  std::vector<LadderSource<3>> sources{sourceWithErrors(1e-14, 0.0, 0.0, nullptr)};
  climb(sources, 1e-12, {});
  EXPECT_EQ(sources[0].step.rung, Rung::kDouble);
}

TEST(Ladder, LetsOnlyTheWideOnesClimb) {
  std::vector<LadderSource<3>> sources{sourceWithErrors(1e-15, 0.0, 0.0, nullptr),
                                       sourceWithErrors(1e-8, 1e-20, 0.0, nullptr),
                                       sourceWithErrors(1e-8, 1e-9, 0.0, nullptr)};
  climb(sources, 1e-12, {});
  EXPECT_EQ(sources[0].step.rung, Rung::kDouble);
  EXPECT_EQ(sources[1].step.rung, Rung::kExtended);
  EXPECT_EQ(sources[2].step.rung, Rung::kBall);
}

TEST(Ladder, WeighsErrorsWithRadiance) {
  std::vector<LadderSource<3>> sources{sourceWithErrors(1e-13, 1e-25, 0.0, nullptr),
                                       sourceWithErrors(1e-9, 1e-25, 0.0, nullptr)};
  sources[1].radiance = 1e-6;
  climb(sources, 1e-12, {});
  EXPECT_EQ(sources[0].step.rung, Rung::kDouble);
  EXPECT_EQ(sources[1].step.rung, Rung::kDouble);
}

TEST(Ladder, RaisesThePrecisionOfBalls) {
  std::vector<Rung> visited;
  std::vector<LadderSource<3>> sources{sourceWithErrors(1.0, 1.0, 0x1p400, &visited)};
  climb(sources, 1e-12, {});
  // 2^(400 - 512) is the first below 1e-12.
  EXPECT_EQ(sources[0].step.bits, 512);
  EXPECT_EQ(visited.front(), Rung::kDouble);
}

TEST(Ladder, ATermSizeWithoutBoundMeetsNothing) {
  QuantityState state{1.0L, 1e-3L, 1.0L};
  EXPECT_FALSE(state.meets(1e-12));
  state.size = std::numeric_limits<long double>::infinity();
  EXPECT_FALSE(state.meets(1e-12));
  // What all terms cancel to is still near enough where their size is known.
  EXPECT_TRUE((QuantityState{0.0L, 1e-330L, 1.0L}.meets(1e-12)));
}

TEST(Ladder, EndsWhereTheLastStepDoesNotSuffice) {
  std::vector<LadderSource<3>> sources{sourceWithErrors(1.0, 1.0, std::numeric_limits<double>::infinity(), nullptr)};
  const CertifiedValue<3> value = climb(sources, 1e-12, {});
  EXPECT_EQ(sources[0].step.bits, kMostBits);
  EXPECT_FALSE(meets(value, 1e-12, {}));
}

TEST(Ladder, GoesOnWhereAStepIsUndecided) {
  std::vector<LadderSource<3>> sources(1);
  sources[0].evaluate = [](const LadderStep& step) -> CertifiedValue<3> {
    if (step.rung != Rung::kBall) throw Undecided("which way");
    return ones(1e-14);
  };
  const CertifiedValue<3> value = climb(sources, 1e-12, {});
  EXPECT_EQ(sources[0].step.rung, Rung::kBall);
  EXPECT_TRUE(meets(value, 1e-12, {}));
}

TEST(Ladder, DoesNotWaitForWhatDoesNotExist) {
  std::vector<LadderSource<3>> sources(1);
  sources[0].evaluate = [](const LadderStep&) {
    CertifiedValue<3> value = ones(1e-14);
    value.rounded.hessian.value(0, 0) = RunningBound<double>::unbounded();
    return value;
  };
  WantedQuantities wanted;
  wanted.hessian = false;
  climb(sources, 1e-12, wanted);
  EXPECT_EQ(sources[0].step.rung, Rung::kDouble);
  // The twin: it does wait for what exists.
  sources[0].step = {};
  climb(sources, 1e-12, {});
  EXPECT_EQ(sources[0].step.bits, kMostBits);
}

TEST(Ladder, SkipsDoubleWordsWhereTheyCannotSuffice) {
  EXPECT_EQ(above({Rung::kDouble, 0}, 1e-12).rung, Rung::kExtended);
  EXPECT_EQ(above({Rung::kDouble, 0}, 1e-40).rung, Rung::kBall);
  EXPECT_GE(firstBits(1e-60), 200);
}

TEST(Ladder, ADerivativeThatVanishesNeedsNoRelativeError) {
  QuantityState zero{0.0L, 0.0L, 1.0L};
  zero.error = std::ldexp(1e-12L, -1025);
  EXPECT_TRUE(zero.meets(1e-12));
  zero.error = std::ldexp(1e-12L, -1000);
  EXPECT_FALSE(zero.meets(1e-12));
  const QuantityState small{1e-40L, 1e-48L, 1.0L};
  EXPECT_FALSE(small.meets(1e-12));
  EXPECT_TRUE(small.meets(1e-7));
}

TEST(Ladder, ABoundThatIsNotKnownIsInfinite) {
  CertifiedValue<3> value = ones(1e-14);
  value.rounded.hessian.value(0, 0) = RunningBound<double>(0.0, std::numeric_limits<double>::quiet_NaN());
  value.rounded.gradient.value(1) = RunningBound<double>::unbounded();
  IrradianceDerivatives<double> derivatives;
  DerivativeBounds bounds;
  roundTo(value, derivatives, bounds);
  EXPECT_EQ(bounds.hessian, std::numeric_limits<double>::infinity());
  EXPECT_EQ(bounds.gradient, std::numeric_limits<double>::infinity());
  EXPECT_LT(bounds.irradiance, 2e-14);
}

TEST(Ladder, RefusesTolerancesOutOfRange) {
  EXPECT_NO_THROW(requireTolerance(1e-60));
  EXPECT_NO_THROW(requireTolerance(1.0));
  for (const double wrong : {0.0, -1e-12, 1e-61, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(requireTolerance(wrong), std::invalid_argument) << wrong;
  }
}

}  // namespace
}  // namespace irradiff
