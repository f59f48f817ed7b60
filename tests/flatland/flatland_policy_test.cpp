#include "derivatives/flatland/flatland_scene.h"
#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/scene/invalid_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using testing::AllOf;
using testing::HasSubstr;

using Scene = std::vector<Segment>;

const Vector2d kUp(0.0, 1.0);
const FlatlandReceiver kOrigin{Vector2d(0.0, 0.0), kUp};
const Segment kLamp{"lamp", {Vector2d(-2.0, 2.0), Vector2d(2.0, 2.0)}, 1.0};

Segment segment(const std::string& name, const Vector2d& a, const Vector2d& b, double radiance) {
  return {name, {a, b}, radiance};
}

SceneEvaluation<2> evaluate(const Scene& scene, const FlatlandReceiver& receiver = kOrigin) {
  return evaluateScene(scene, receiver);
}

std::string messageFor(const Scene& scene, const FlatlandReceiver& receiver = kOrigin) {
  try {
    evaluateScene(scene, receiver);
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "";
}

/// E of radiance 1 between two points, by the sines of their angles from a normal that points up.
double between(const Vector2d& right, const Vector2d& left) { return right(0) / right.norm() - left(0) / left.norm(); }

void expectIrradiance(const SceneEvaluation<2>& evaluation, double expected) {
  // The expected value has four roundings of numbers up to 1.
  EXPECT_NEAR(evaluation.derivatives.irradiance.value, expected, evaluation.bounds.irradiance + 0x1p-51);
}

void expectEverythingExists(const SceneEvaluation<2>& evaluation) {
  EXPECT_EQ(evaluation.no_gradient, "");
  EXPECT_EQ(evaluation.no_hessian, "");
  EXPECT_EQ(evaluation.no_tangential_hessian, "");
}

void expectNoGradient(const SceneEvaluation<2>& evaluation, const std::string& part) {
  EXPECT_THAT(evaluation.no_gradient, HasSubstr(part));
  EXPECT_EQ(evaluation.no_hessian, evaluation.no_gradient);
  EXPECT_EQ(evaluation.no_tangential_hessian, evaluation.no_gradient);
  EXPECT_EQ(evaluation.no_irradiance, "");
}

TEST(FlatlandPolicy, ABlockerHidesTheMiddleOfALamp) {
  const SceneEvaluation<2> evaluation = evaluate({kLamp, segment("blocker", {-0.5, 1.0}, {0.5, 1.0}, 0.0)});
  expectIrradiance(evaluation, std::numbers::sqrt2 - 2.0 / std::sqrt(5.0));
  expectEverythingExists(evaluation);
  EXPECT_TRUE(evaluation.has_occlusion);
  EXPECT_FALSE(evaluation.crosses_horizon);
  // E(x) = g(2 - x, 2) + g(2 + x, 2) - g(1/2 - x, 1) - g(1/2 + x, 1) with g(s, h) = s/sqrt(s^2 + h^2); its second
  // derivative along x is twice that of g in s, -3 s h^2/(s^2 + h^2)^(5/2).
  const double expected = -2.0 * 24.0 / std::pow(8.0, 2.5) + 2.0 * 1.5 / std::pow(1.25, 2.5);
  EXPECT_NEAR(evaluation.derivatives.hessian.value(0, 0), expected, evaluation.bounds.hessian + 0x1p-50);
  EXPECT_LE(std::abs(evaluation.derivatives.gradient.value(0)), evaluation.bounds.gradient);
}

TEST(FlatlandPolicy, CountsWhatBecameOfEachSegment) {
  const Scene scene = {
      segment("floor", {-3.0, 0.0}, {3.0, 0.0}, 1.0),  segment("cellar", {-3.0, -1.0}, {3.0, -1.0}, 1.0),
      segment("fin", {-4.0, 4.0}, {-5.0, 5.0}, 1.0),   kLamp,
      segment("screen", {-0.5, 1.0}, {0.5, 1.0}, 0.0), segment("behind", {-0.1, 1.5}, {0.1, 1.5}, 9.0),
      segment("window", {5.0, 1.0}, {5.0, 2.0}, 1.0),  segment("star", {-50.0, 30.0}, {-50.0, 30.1}, 1.0)};
  const SourceCounts counts = evaluate(scene).sources.value();
  for (const std::size_t count : {counts.own_surface, counts.below_horizon, counts.edge_on, counts.hidden, counts.black,
                                  counts.partly_hidden, counts.boundary, counts.area_rule}) {
    EXPECT_EQ(count, 1U);
  }
  EXPECT_EQ(evaluate({kLamp}).sources.value().boundary, 1U);
}

TEST(FlatlandPolicy, TheFrontMostOfSegmentsThatPassThroughEachOtherIsSeen) {
  const Scene scene = {segment("rising", {-1.0, 1.0}, {1.0, 3.0}, 1.0),
                       segment("falling", {-1.0, 3.0}, {1.0, 1.0}, 4.0)};
  const SceneEvaluation<2> evaluation = evaluate(scene);
  expectIrradiance(evaluation, between({0.0, 2.0}, {-1.0, 1.0}) + 4.0 * between({1.0, 1.0}, {0.0, 2.0}));
  expectEverythingExists(evaluation);
}

TEST(FlatlandPolicy, ItsOwnSurfaceHidesNothingFromTheReceiver) {
  const Segment floor = segment("floor", {-3.0, 0.0}, {3.0, 0.0}, 5.0);
  const SceneEvaluation<2> evaluation = evaluate({floor, kLamp});
  const SceneEvaluation<2> alone = evaluate({kLamp});
  EXPECT_EQ(evaluation.derivatives.irradiance.value, alone.derivatives.irradiance.value);
  EXPECT_EQ(evaluation.derivatives.hessian.value, alone.derivatives.hessian.value);
  EXPECT_FALSE(evaluation.has_occlusion);
  // Just below the floor it hides everything.
  EXPECT_EQ(evaluate({segment("floor", {-3.0, 1e-9}, {3.0, 1e-9}, 0.0), kLamp}).derivatives.irradiance.value, 0.0);
  EXPECT_THAT(messageFor({floor, kLamp}, {Vector2d(0.0, 0.0), Vector2d(0.6, 0.8)}), HasSubstr("is inside it"));
  EXPECT_THAT(messageFor({floor, kLamp}, {Vector2d(3.0, 0.0), kUp}), HasSubstr("one of its ends"));
}

TEST(FlatlandPolicy, WhatTouchesTheHorizonOfAReceiverOnASurfaceDoesNotCount) {
  // The top of a box: its sides hang down from the ends of the surface, neighbours continue it.
  const Segment top = segment("top", {-1.0, 0.0}, {1.0, 0.0}, 0.0);
  const Segment side = segment("side", {1.0, 0.0}, {1.0, -1.0}, 1.0);
  const Segment neighbour = segment("neighbour", {-1.0, 0.0}, {-4.0, 0.0}, 1.0);
  expectEverythingExists(evaluate({top, side, neighbour, kLamp}));
  // In free space a move against the normal brings it into view.
  EXPECT_THAT(evaluate({side, kLamp}).no_hessian, AllOf(HasSubstr("\"side\""), HasSubstr("horizon")));
  EXPECT_THAT(evaluate({neighbour, kLamp}).no_hessian, HasSubstr("\"neighbour\""));
  EXPECT_EQ(evaluate({side, neighbour, kLamp}).no_tangential_hessian, "");
}

TEST(FlatlandPolicy, OverlapsOnOneLineOfDifferentRadianceAreRefusedWhereTheyAreSeen) {
  const Segment dimmer = segment("dimmer", {1.0, 2.0}, {3.0, 2.0}, 0.5);
  EXPECT_THAT(messageFor({kLamp, dimmer}),
              AllOf(HasSubstr("segments[0] \"lamp\""), HasSubstr("segments[1] \"dimmer\""), HasSubstr("overlap")));
  // Hidden they do not matter, nor below the horizon, nor where they only touch.
  EXPECT_EQ(messageFor({kLamp, dimmer, segment("wall", {0.5, 1.0}, {2.0, 1.0}, 0.0)}), "");
  EXPECT_EQ(messageFor({kLamp, dimmer}, {Vector2d(0.0, 0.0), -kUp}), "");
  EXPECT_EQ(messageFor({kLamp, segment("next", {2.0, 2.0}, {3.0, 2.0}, 0.5)}), "");
  // A third of the same line and the first's radiance in between.
  EXPECT_THAT(messageFor({segment("a", {-2.0, 2.0}, {0.0, 2.0}, 1.0), segment("b", {-1.0, 2.0}, {1.0, 2.0}, 1.0),
                          segment("c", {0.5, 2.0}, {2.0, 2.0}, 3.0)}),
              AllOf(HasSubstr("\"b\""), HasSubstr("\"c\"")));
}

TEST(FlatlandPolicy, DuplicatesAndOverlapsOfOneRadianceAreOneSegment) {
  const SceneEvaluation<2> once = evaluate({kLamp});
  const SceneEvaluation<2> twice = evaluate({kLamp, kLamp});
  EXPECT_EQ(once.derivatives.irradiance.value, twice.derivatives.irradiance.value);
  EXPECT_EQ(once.derivatives.gradient.value, twice.derivatives.gradient.value);
  EXPECT_EQ(once.derivatives.hessian.value, twice.derivatives.hessian.value);
  expectEverythingExists(twice);
  const SceneEvaluation<2> parts =
      evaluate({segment("left", {-2.0, 2.0}, {1.0, 2.0}, 1.0), segment("right", {-1.0, 2.0}, {2.0, 2.0}, 1.0)});
  expectIrradiance(parts, std::numbers::sqrt2);
  expectEverythingExists(parts);
  EXPECT_LE((parts.derivatives.hessian.value - once.derivatives.hessian.value).cwiseAbs().maxCoeff(),
            parts.bounds.hessian + once.bounds.hessian);
}

TEST(FlatlandPolicy, ASharedEndIsNoEvent) {
  // A corner that is seen from outside: both sides of it, or one that hides the other.
  const Vector2d corner(0.3, 1.0);
  for (const Vector2d& other : {Vector2d(1.0, 2.0), Vector2d(-0.5, 2.0), Vector2d(0.2, 3.0)}) {
    const SceneEvaluation<2> evaluation =
        evaluate({kLamp, segment("one", {-0.2, 1.2}, corner, 0.5), segment("two", corner, other, 2.0)});
    expectEverythingExists(evaluation);
    EXPECT_TRUE(evaluation.has_occlusion);
  }
}

TEST(FlatlandPolicy, EndsInLineAreAnEventWhereRadiancesMakeThemOne) {
  const Segment near = segment("near", {-1.0, 1.0}, {0.5, 1.0}, 3.0);
  const Segment far = segment("far", {-1.0, 2.0}, {1.0, 2.0}, 2.0);
  const SceneEvaluation<2> same_side = evaluate({near, far});
  expectNoGradient(same_side, "segments[0] \"near\" has an end in line with an end of segments[1] \"far\"");
  expectIrradiance(same_side, 3.0 * between({0.5, 1.0}, {-1.0, 1.0}));
  // One begins where the other ends.
  const Segment beyond = segment("beyond", {1.0, 2.0}, {3.0, 2.0}, 2.0);
  expectNoGradient(evaluate({near, beyond}), "in line");
  // What may come into view is black before a black sky, or of the radiance that is behind it.
  Segment black = far;
  black.radiance = 0.0;
  expectEverythingExists(evaluate({near, black}));
  const Segment sky = segment("sky", {-9.0, 5.0}, {9.0, 5.0}, 2.0);
  expectEverythingExists(evaluate({near, far, sky}));
  expectEverythingExists(evaluate({near, beyond, sky}));
  // A wall in front hides the event, one between the two ends does too.
  expectEverythingExists(evaluate({near, far, segment("wall", {0.2, 0.8}, {0.8, 0.8}, 1.0)}));
  expectEverythingExists(evaluate({near, far, segment("wall", {0.4, 1.5}, {1.4, 1.5}, 1.0)}));
}

TEST(FlatlandPolicy, AnEndInLineWithACrossingIsAnEvent) {
  const Scene cross = {segment("rising", {-1.0, 1.0}, {1.0, 3.0}, 1.0),
                       segment("falling", {-1.0, 3.0}, {1.0, 1.0}, 4.0), segment("edge", {0.0, 0.5}, {2.0, 0.5}, 2.0)};
  expectNoGradient(evaluate(cross), "\"edge\" has an end in line with a crossing");
}

TEST(FlatlandPolicy, EndOnSegmentsMatterWhereTheyWouldBeSeen) {
  const Segment end_on = segment("blade", {0.0, 0.5}, {0.0, 1.0}, 3.0);
  expectNoGradient(evaluate({kLamp, end_on}), "segments[1] \"blade\" is seen end-on");
  expectIrradiance(evaluate({kLamp, end_on}), std::numbers::sqrt2);
  Segment alike = end_on;
  alike.radiance = 1.0;
  expectEverythingExists(evaluate({kLamp, alike}));
  expectEverythingExists(evaluate({kLamp, end_on, segment("wall", {-0.1, 0.2}, {0.1, 0.2}, 0.0)}));
  // A black one hides the lamp, and nothing of a black sky.
  Segment black = end_on;
  black.radiance = 0.0;
  expectNoGradient(evaluate({kLamp, black}), "end-on");
  expectEverythingExists(evaluate({black}));
}

TEST(FlatlandPolicy, TheHorizonCutsWhatIsSeenInPart) {
  // The wall passes below the horizon on the right; a blocker hides its upper part.
  const Scene scene = {segment("wall", {2.0, -1.0}, {2.0, 4.0}, 1.0), segment("blocker", {1.0, 1.0}, {1.0, 9.0}, 0.0)};
  const SceneEvaluation<2> evaluation = evaluate(scene);
  expectIrradiance(evaluation, 1.0 - std::numbers::sqrt2 / 2.0);
  expectEverythingExists(evaluation);
  EXPECT_TRUE(evaluation.crosses_horizon);
  // E = 1 - (1 - x)/sqrt((1 - x)^2 + (1 - y)^2), whatever the wall's own end.
  EXPECT_NEAR(evaluation.derivatives.gradient.value(0), 1.0 / std::sqrt(8.0), evaluation.bounds.gradient + 0x1p-53);
  EXPECT_NEAR(evaluation.derivatives.gradient.value(1), -1.0 / std::sqrt(8.0), evaluation.bounds.gradient + 0x1p-53);
}

TEST(FlatlandPolicy, AnEndOnTheHorizonLeavesNoHessianWhereItIsSeen) {
  const Segment wall = segment("wall", {2.0, 0.0}, {2.0, 2.0}, 1.0);
  const SceneEvaluation<2> seen = evaluate({wall});
  EXPECT_THAT(seen.no_hessian, AllOf(HasSubstr("\"wall\""), HasSubstr("horizon")));
  EXPECT_EQ(seen.no_gradient, "");
  EXPECT_EQ(seen.no_tangential_hessian, "");
  // Hidden, it does not count; nor where the wall goes on below.
  expectEverythingExists(evaluate({wall, segment("screen", {1.0, -1.0}, {1.0, 0.5}, 0.5)}));
  expectEverythingExists(evaluate({wall, segment("lower wall", {2.0, 0.0}, {2.0, -2.0}, 1.0)}));
}

TEST(FlatlandPolicy, WhatLiesAlongTheHorizonHidesNothingBeyondItsEnd) {
  // A move against the normal brings the strip before the wall, and what hangs behind the strip, into view.
  const Segment wall = segment("wall", {4.0, -1.0}, {4.0, 3.0}, 1.0);
  const Segment strip = segment("strip", {1.0, 0.0}, {2.0, 0.0}, 1.0);
  expectEverythingExists(evaluate({wall, strip}));
  EXPECT_THAT(evaluate({wall, strip, segment("hanging", {3.0, 0.0}, {3.0, -2.0}, 2.0)}).no_hessian,
              HasSubstr("horizon"));
}

TEST(FlatlandPolicy, NumbersOutOfRangeBesideEachOtherAreRefusedWhereTheyMeet) {
  const Segment tiny = segment("tiny", {-1e-120, 1e-120}, {0.5e-120, 1e-120}, 1.0);
  const Segment huge = segment("huge", {-1e120, 1e120}, {1e120, 1e120}, 1.0);
  EXPECT_EQ(messageFor({tiny}), "");
  EXPECT_EQ(messageFor({huge}), "");
  EXPECT_THAT(messageFor({tiny, huge}), AllOf(HasSubstr("\"huge\", seen in part"), HasSubstr("2^-500")));
}

}  // namespace
}  // namespace irradiff
