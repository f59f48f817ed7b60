#include "derivatives/flatland/segment_evaluation.h"

#include "derivatives/scene/invalid_scene.h"
#include "verification/checks/flatland_suite.h"
#include "verification/checks/input_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using testing::AllOf;
using testing::HasSubstr;

const Segment kLamp{"lamp", {Vector2d(-1.0, 1.0), Vector2d(1.0, 1.0)}, 1.0};
const Vector2d kUp(0.0, 1.0);

std::string messageFor(const FlatlandReceiver& receiver) {
  try {
    evaluateSegment(kLamp, 2, receiver);
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "";
}

FlatlandSuiteOptions suiteOptions() {
  FlatlandSuiteOptions options;
  options.inputs = lengthened(40);
  options.reference_folder = "data/reference";
  return options;
}

TEST(EvaluateSegment, PassesEveryCheck) {
  for (const Verdict& verdict : checkFlatland(flatlandCandidate(), suiteOptions())) {
    EXPECT_TRUE(verdict.passed) << describe(verdict);
  }
}

TEST(EvaluateSegment, EveryCheckRejectsATwinThatIsOnePerCentTooLarge) {
  const FlatlandCandidate right = flatlandCandidate();
  const FlatlandCandidate twin{
      "one per cent too large",
      [right](const FlatlandConfiguration& c) { return 1.01 * right.irradiance(c); },
      [right](const FlatlandConfiguration& c) -> Vector2d { return 1.01 * right.gradient(c); },
      [right](const FlatlandConfiguration& c) -> Eigen::Matrix2d { return 1.01 * right.hessian(c); },
      [right](const FlatlandConfiguration& c) { return 1.01 * right.tangential_hessian(c); },
      [right](const FlatlandConfiguration& c) { return 1.01 * right.rotational_gradient(c); },
      right.bounds};
  FlatlandSuiteOptions options = suiteOptions();
  options.inputs = 5;
  for (const Verdict& verdict : checkFlatland(twin, options)) {
    // Derivatives that sum to nothing still do when all are scaled.
    if (verdict.check != "closure" || verdict.quantity == Quantity::kFormFactor) {
      EXPECT_FALSE(verdict.passed) << describe(verdict);
    }
  }
}

TEST(EvaluateSegment, BoundsRejectATwinThatThrowsWhereTheyAreAllThatIsPromised) {
  const FlatlandCandidate right = flatlandCandidate();
  FlatlandCandidate twin = right;
  // Long segments are drawn nowhere else.
  twin.gradient = [right](const FlatlandConfiguration& c) -> Vector2d {
    if ((c.segment.vertices[1] - c.segment.vertices[0]).norm() > 1e3) {
      throw std::runtime_error("too long");
    }
    return right.gradient(c);
  };
  FlatlandSuiteOptions options = suiteOptions();
  options.reference_folder.clear();
  for (const Verdict& verdict : checkFlatland(twin, options)) {
    const bool is_hit = verdict.family == "flatland, combined extremes" && verdict.quantity == Quantity::kGradient;
    EXPECT_EQ(verdict.passed, !is_hit) << describe(verdict);
  }
}

TEST(EvaluateSegment, ClosureRejectsATwinThatForgetsTheHorizon) {
  // A twin that gives half of a derivative wherever the horizon cuts.
  const FlatlandCandidate right = flatlandCandidate();
  FlatlandCandidate twin = right;
  const auto share = [](const FlatlandConfiguration& c) {
    return evaluateSegment(c.segment, 0, c.receiver).crosses_horizon ? 0.5 : 1.0;
  };
  twin.gradient = [right, share](const FlatlandConfiguration& c) -> Vector2d { return share(c) * right.gradient(c); };
  twin.hessian = [right, share](const FlatlandConfiguration& c) -> Eigen::Matrix2d {
    return share(c) * right.hessian(c);
  };
  twin.tangential_hessian = [right, share](const FlatlandConfiguration& c) {
    return share(c) * right.tangential_hessian(c);
  };
  twin.rotational_gradient = [right, share](const FlatlandConfiguration& c) {
    return share(c) * right.rotational_gradient(c);
  };
  FlatlandSuiteOptions options = suiteOptions();
  for (const Verdict& verdict : checkFlatland(twin, options)) {
    if (verdict.check == "closure") {
      EXPECT_EQ(verdict.passed, verdict.quantity == Quantity::kFormFactor) << describe(verdict);
    }
  }
}

TEST(EvaluateSegment, RefusesAReceiverOnAnEnd) {
  EXPECT_THAT(messageFor({Vector2d(1.0, 1.0), -kUp}),
              AllOf(HasSubstr("segments[2] \"lamp\""), HasSubstr("one of its ends"), HasSubstr("[1, 1]")));
}

TEST(EvaluateSegment, RefusesATiltedReceiverInside) {
  EXPECT_THAT(messageFor({Vector2d(0.5, 1.0), Vector2d(0.6, 0.8)}), HasSubstr("is inside it"));
}

TEST(EvaluateSegment, RefusesNumbersThatUnderflowBesideOthers) {
  EXPECT_THAT(messageFor({Vector2d(1e-160, 0.0), kUp}),
              AllOf(HasSubstr("segments[2] \"lamp\""), HasSubstr("must be 0 or at least 2^-500 of the largest")));
  EXPECT_THAT(messageFor({Vector2d(0.0, 0.0), Vector2d(1e-140, 1.0)}), HasSubstr("component of its normal"));
}

TEST(EvaluateSegment, SeesASegmentThatStartsAlmostAtTheReceiver) {
  // The difference of the ends has nothing left of the nearer one, in double words neither.
  for (const double near : {1e-20, 1e-33, 1e-60}) {
    for (const bool is_swapped : {false, true}) {
      Segment segment{"lamp", {Vector2d(-1.1, 3.1), Vector2d(1.8 * near, 2.3 * near)}, 1.0};
      if (is_swapped) std::swap(segment.vertices[0], segment.vertices[1]);
      const SegmentEvaluation evaluation = evaluateSegment(segment, 0, {Vector2d(0.0, 0.0), Vector2d(0.6, 0.8)});
      // The integral of n.w over the angle, between the directions of the ends.
      const Vector2d turned = Vector2d(-1.1, 3.1).normalized() - Vector2d(1.8, 2.3).normalized();
      const double expected = 0.6 * turned(1) - 0.8 * turned(0);
      EXPECT_NEAR(evaluation.derivatives.irradiance.value, expected, 0x1p-50) << near;
    }
  }
}

TEST(EvaluateSegment, CutsAtTheHorizonWhereTheFarEndIsVeryFar) {
  // From the cut in direction (0.8, -0.6) to nearly (1, 0): E = 0.2.
  for (const double far : {1e3, 1e20, 1e30, 1e60}) {
    const Segment segment{"floor", {Vector2d(0.0, 0.0), Vector2d(2.0 * far, 0.0)}, 1.0};
    const SegmentEvaluation evaluation = evaluateSegment(segment, 0, {Vector2d(0.0, 0.9), Vector2d(0.6, 0.8)});
    const double angle = std::atan2(-0.9, 2.0 * far);
    const double expected = 0.6 * (std::sin(angle) + 0.6) - 0.8 * (std::cos(angle) - 0.8);
    EXPECT_NEAR(evaluation.derivatives.irradiance.value, expected, 0x1p-50) << far;
  }
}

TEST(EvaluateSegment, OwnSurfaceAndEndOn) {
  EXPECT_EQ(evaluateSegment(kLamp, 0, {Vector2d(0.5, 1.0), kUp}).derivatives.irradiance.value, 0.0);
  const SegmentEvaluation end_on = evaluateSegment(kLamp, 0, {Vector2d(2.0, 1.0), Vector2d(-1.0, 0.0)});
  EXPECT_EQ(end_on.derivatives.irradiance.value, 0.0);
  EXPECT_THAT(end_on.no_gradient, HasSubstr("end-on"));
}

TEST(EvaluateSegment, EndOnTheHorizonHasAOneSidedHessian) {
  const Segment wall{"wall", {Vector2d(1.0, 0.0), Vector2d(1.0, 2.0)}, 1.0};
  const SegmentEvaluation evaluation = evaluateSegment(wall, 0, {Vector2d(0.0, 0.0), kUp});
  EXPECT_THAT(evaluation.no_hessian, HasSubstr("horizon"));
  EXPECT_TRUE(evaluation.no_gradient.empty());
}

}  // namespace
}  // namespace irradiff
