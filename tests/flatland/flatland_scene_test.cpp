#include "derivatives/flatland/flatland_scene.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/flatland/segment_visibility.h"
#include "derivatives/flatland/visible_part.h"
#include "derivatives/scene/invalid_scene.h"
#include "tests/flatland/flatland_scene_check.h"
#include "tests/flatland/rational_scene.h"
#include "verification/checks/input_families.h"

#include <ceres/jet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120814;

TEST(EvaluateScene, IsRightToItsBoundAndToThePromise) {
  for (const SceneFamily& family : smoothFamilies()) {
    const SceneVerdict verdict = checkScenes(evaluateByLibrary, family, lengthened(1000), kSeed);
    std::cout << family.name << ", seed " << kSeed << ": " << verdict.text();
    EXPECT_LE(verdict.bound_share, 1.0);
    EXPECT_LE(verdict.norm_wise_far, 1e-13);
    EXPECT_GT(verdict.far, lengthened(1000) / 2);
    EXPECT_LT(verdict.at_events, lengthened(1000) / 100);
  }
}

TEST(EvaluateScene, IsRightToItsBoundInHarshScenes) {
  for (const SceneFamily& family : harshFamilies()) {
    const SceneVerdict verdict = checkScenes(evaluateByLibrary, family, lengthened(400), kSeed);
    std::cout << family.name << ", seed " << kSeed << ": " << verdict.text();
    EXPECT_LE(verdict.bound_share, 1.0);
    EXPECT_GT(verdict.judged, lengthened(400) / 2);
  }
}

TEST(EvaluateScene, TurnsWithTheNormal) {
  for (const SceneFamily& family : smoothFamilies()) {
    double largest = 0.0;
    for (std::size_t i = 0; i < lengthened(200); ++i) {
      KeyedRandom random(kSeed, family.name, i);
      const FlatlandScene scene = family.draw(random);
      double radiance = 0.0;
      for (const Segment& segment : scene.segments) radiance = std::max(radiance, segment.radiance);
      const ManyDigits expected = RationalScene(scene.segments, scene.receiver, {}).rotationalGradient();
      const double actual = evaluateByLibrary(scene).derivatives.rotational_gradient.value(0);
      // Of a half circle of the largest radiance it is at most 2.
      largest = std::max(largest, abs(ManyDigits(actual - expected)).convert_to<double>() / (2.0 * radiance));
    }
    std::cout << family.name << ", seed " << kSeed << ": rotational gradient " << largest
              << " of the largest possible\n";
    EXPECT_LE(largest, 1e-13);
    EXPECT_GT(largest, 0.0);
  }
}

TEST(EvaluateScene, SaysWhereDerivativesExistOnGrids) {
  std::size_t wrong = 0;
  std::size_t events = 0;
  std::size_t one_sided = 0;
  std::string first_wrong;
  for (std::size_t i = 0; i < lengthened(1500); ++i) {
    KeyedRandom random(kSeed, "grid", i);
    const FlatlandScene scene = drawGrid(random);
    try {
      const std::string failure = checkExistence(evaluateByLibrary, scene);
      if (!failure.empty() && wrong++ == 0) first_wrong = failure + ": " + sceneLine(scene);
      const SceneEvaluation<2> evaluation = evaluateByLibrary(scene);
      events += evaluation.no_gradient.empty() ? 0 : 1;
      one_sided += evaluation.no_gradient.empty() && !evaluation.no_hessian.empty() ? 1 : 0;
    } catch (const InvalidScene&) {
      // Overlaps on one line: segment_visibility_test.cpp holds them to the oracle.
    }
  }
  std::cout << "grids, seed " << kSeed << ": " << events << " without a gradient, " << one_sided
            << " without a Hessian alone\n";
  EXPECT_EQ(wrong, 0) << first_wrong;
  EXPECT_GT(events, 50);
  EXPECT_GT(one_sided, 50);
}

SceneEvaluation<2> sumOfWholeSegments(const FlatlandScene& scene) {
  SceneEvaluation<2> sum = darkScene<2>();
  for (std::size_t i = 0; i < scene.segments.size(); ++i) {
    const SegmentEvaluation evaluation = evaluateSegment(scene.segments[i], i, scene.receiver);
    if (scene.segments[i].radiance > 0.0) {
      addSource(sum, evaluation.derivatives, evaluation.bounds, scene.segments[i].radiance);
    }
  }
  return sum;
}

SegmentVisibility viewOf(const FlatlandScene& scene) {
  std::vector<std::size_t> considered(scene.segments.size());
  std::iota(considered.begin(), considered.end(), std::size_t{0});
  return visibleParts(scene.segments, considered, scene.receiver);
}

template <class Scalar>
std::vector<SegmentEnds<Scalar>> endsOf(const FlatlandScene& scene) {
  std::vector<SegmentEnds<Scalar>> ends;
  for (const Segment& s : scene.segments) {
    const auto& [a, b] = s.vertices;
    ends.push_back({Vector2<Scalar>(lift<Scalar>(a(0)), lift<Scalar>(a(1))),
                    Vector2<Scalar>(lift<Scalar>(b(0)), lift<Scalar>(b(1)))});
  }
  return ends;
}

/// The sums over the visible parts at any Scalar, the topology being that of the receiver's doubles. `change` may alter
/// a part's boundary points.
template <class Scalar, class Change>
IrradianceDerivatives<Scalar, 2> frozenSums(const FlatlandScene& scene, const Vector2<Scalar>& position,
                                            const Change& change) {
  const std::vector<SegmentEnds<Scalar>> ends = endsOf<Scalar>(scene);
  const Vector2<Scalar> normal(lift<Scalar>(scene.receiver.normal(0)), lift<Scalar>(scene.receiver.normal(1)));
  const Scalar zero = lift<Scalar>(0.0);
  IrradianceDerivatives<Scalar, 2> sum{{zero}, {{zero, zero}}, {Matrix2<Scalar>::Constant(zero)}, {}, {}};
  for (const VisiblePart& part : viewOf(scene).parts) {
    ClippedSegment<Scalar> clipped = clipPart<Scalar>(part, ends, position, normal);
    change(part, clipped);
    const IrradianceDerivatives<Scalar, 2> d = segmentBoundaryForm<Scalar>(clipped, normal).derivatives;
    const Scalar radiance = lift<Scalar>(scene.segments[part.segment].radiance);
    sum.irradiance.value = sum.irradiance.value + radiance * d.irradiance.value;
    for (int i = 0; i < 2; ++i) {
      sum.gradient.value(i) = sum.gradient.value(i) + radiance * d.gradient.value(i);
      for (int j = 0; j < 2; ++j) {
        sum.hessian.value(i, j) = sum.hessian.value(i, j) + radiance * d.hessian.value(i, j);
      }
    }
  }
  return sum;
}

constexpr auto kUnchanged = [](const VisiblePart&, const auto&) {};

/// A twin that sums parts whose boundary points `change` has altered, with the library's irradiance and bounds.
template <class Change>
SceneCandidate twinOfParts(const Change& change) {
  return [change](const FlatlandScene& scene) {
    SceneEvaluation<2> evaluation = evaluateByLibrary(scene);
    const IrradianceDerivatives<double, 2> sums = frozenSums<double>(scene, scene.receiver.position, change);
    evaluation.derivatives.gradient = sums.gradient;
    evaluation.derivatives.hessian = sums.hessian;
    return evaluation;
  };
}

/// Where the ray to a boundary point in front of a segment meets the segment itself.
void moveToOwnLine(const Segment& segment, const Eigen::Vector2d& position, Vector2<DoubleWord<double>>& point,
                   double& height) {
  const Eigen::Vector2d e = segment.vertices[1] - segment.vertices[0];
  const Eigen::Vector2d r = segment.vertices[0] - position;
  const Eigen::Vector2d w = narrow<double>(point);
  const double factor = (r(0) * e(1) - r(1) * e(0)) / (w(0) * e(1) - w(1) * e(0));
  point = widen<DoubleWord<double>>(Vector2<double>(factor * w));
  height *= factor;
}

TEST(EvaluateScene, TheCheckRejectsTwins) {
  const SceneFamily& family = smoothFamilies()[0];
  const SceneVerdict ignored = checkScenes(sumOfWholeSegments, family, 40, kSeed);
  EXPECT_GT(ignored.norm_wise_far, 0.1);
  EXPECT_GT(ignored.bound_share, 1e6);

  const SceneVerdict unchanged = checkScenes(twinOfParts(kUnchanged), family, 40, kSeed);
  EXPECT_LT(unchanged.norm_wise_far, 1e-12) << "the twins below would fail for another reason";

  // A shadow's boundary belongs to the occluder's depth, not to that of the surface it falls on.
  const SceneVerdict other_side = checkScenes(
      [](const FlatlandScene& scene) {
        return twinOfParts([&scene](const VisiblePart& part, ClippedSegment<double>& clipped) {
          const Segment& own = scene.segments[part.segment];
          if (part.first.segment != part.segment) {
            moveToOwnLine(own, scene.receiver.position, clipped.first, clipped.first_height);
          }
          if (part.last.segment != part.segment) {
            moveToOwnLine(own, scene.receiver.position, clipped.last, clipped.last_height);
          }
        })(scene);
      },
      family, 40, kSeed);
  EXPECT_GT(other_side.norm_wise_far, 0.01);
  EXPECT_GT(other_side.bound_share, 1e6);

  // The part's own end, hidden, in place of the occluder's.
  const SceneVerdict hidden_end = checkScenes(
      [](const FlatlandScene& scene) {
        return twinOfParts([&scene](const VisiblePart& part, ClippedSegment<double>& clipped) {
          if (part.first.segment != part.segment) {
            clipped =
                clipSegment<double>(scene.segments[part.segment].vertices[0], scene.segments[part.segment].vertices[1],
                                    scene.receiver.position, scene.receiver.normal);
          }
        })(scene);
      },
      family, 40, kSeed);
  EXPECT_GT(hidden_end.norm_wise_far, 0.01);
  EXPECT_GT(hidden_end.bound_share, 1e6);
}

TEST(EvaluateScene, ClaimsMoreThanATwinThatIsOnePerCentOff) {
  const SceneVerdict off = checkScenes(
      [](const FlatlandScene& scene) {
        SceneEvaluation<2> evaluation = evaluateByLibrary(scene);
        evaluation.derivatives.hessian.value *= 1.01;
        return evaluation;
      },
      smoothFamilies()[1], 10, kSeed);
  EXPECT_GT(off.norm_wise_far, 0.005);
  EXPECT_GT(off.bound_share, 1e6);
}

TEST(EvaluateScene, ExistenceRejectsTwinsThatDoNotLookBehindEnds) {
  std::size_t silent = 0;
  std::size_t anxious = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    KeyedRandom random(kSeed, "grid", i);
    const FlatlandScene scene = drawGrid(random);
    const auto withReason = [](const std::string& reason) {
      return [reason](const FlatlandScene& s) {
        SceneEvaluation<2> evaluation = evaluateByLibrary(s);
        evaluation.no_gradient = evaluation.no_hessian = reason;
        return evaluation;
      };
    };
    try {
      silent += checkExistence(withReason(""), scene).empty() ? 0 : 1;
      anxious += checkExistence(withReason("always"), scene).empty() ? 0 : 1;
    } catch (const InvalidScene&) {
    }
  }
  EXPECT_GT(silent, 20);
  EXPECT_GT(anxious, 100);
}

TEST(EvaluateScene, JetsOfIrradianceAgreeInFrozenTopology) {
  using Jet = ceres::Jet<ceres::Jet<long double, 2>, 2>;
  for (std::size_t i = 0; i < lengthened(200); ++i) {
    KeyedRandom random(kSeed, "jets", i);
    const FlatlandScene scene = smoothFamilies()[i % 2].draw(random);
    Vector2<Jet> position;
    for (int k = 0; k < 2; ++k) {
      position(k) = Jet(ceres::Jet<long double, 2>(scene.receiver.position(k), k));
      position(k).v[k] = ceres::Jet<long double, 2>(1.0L);
    }
    const Jet e = frozenSums<Jet>(scene, position, kUnchanged).irradiance.value;
    const SceneEvaluation<2> evaluation = evaluateByLibrary(scene);
    // Doubles are no better than their bound; the Jets' own roundings, in long double, are 2^11 times smaller.
    const double share = 1.25;
    EXPECT_LE(std::abs(static_cast<double>(e.a.a - evaluation.derivatives.irradiance.value)),
              share * evaluation.bounds.irradiance);
    for (int k = 0; k < 2; ++k) {
      EXPECT_LE(std::abs(static_cast<double>(e.v[k].a - evaluation.derivatives.gradient.value(k))),
                share * evaluation.bounds.gradient)
          << sceneLine(scene);
      for (int m = 0; m < 2; ++m) {
        EXPECT_LE(std::abs(static_cast<double>(e.v[k].v[m] - evaluation.derivatives.hessian.value(k, m))),
                  share * evaluation.bounds.hessian)
            << sceneLine(scene);
      }
    }
  }
}

TEST(EvaluateScene, MultiprecisionInFrozenTopologyIsTheOraclesIrradiance) {
  for (std::size_t i = 0; i < lengthened(50); ++i) {
    KeyedRandom random(kSeed, "multiprecision", i);
    const FlatlandScene scene = smoothFamilies()[i % 2].draw(random);
    const Vector2<ManyDigits> position(ManyDigits(scene.receiver.position(0)), ManyDigits(scene.receiver.position(1)));
    const ManyDigits e = frozenSums<ManyDigits>(scene, position, kUnchanged).irradiance.value;
    const ManyDigits expected = RationalScene(scene.segments, scene.receiver, {}).visible().irradiance();
    // 150 digits less those of the angles' cancellation and of a normal whose length is 1 to 1e-16 alone.
    EXPECT_LE(abs(ManyDigits(e - expected)), ManyDigits("1e-120") * (1 + expected)) << sceneLine(scene);
  }
}

bool sameBits(const SceneEvaluation<2>& a, const SceneEvaluation<2>& b) {
  return a.derivatives.irradiance.value == b.derivatives.irradiance.value &&
         a.derivatives.gradient.value == b.derivatives.gradient.value &&
         a.derivatives.hessian.value == b.derivatives.hessian.value &&
         a.derivatives.rotational_gradient.value == b.derivatives.rotational_gradient.value &&
         a.bounds.irradiance == b.bounds.irradiance && a.bounds.gradient == b.bounds.gradient &&
         a.bounds.hessian == b.bounds.hessian && a.crosses_horizon == b.crosses_horizon;
}

TEST(EvaluateScene, WithoutOcclusionIsTheSumOfItsSegmentsToTheLastBit) {
  std::size_t compared = 0;
  for (std::size_t i = 0; i < lengthened(2000); ++i) {
    KeyedRandom random(kSeed, "unoccluded", i);
    const FlatlandScene scene = smoothFamilies()[0].draw(random);
    const SceneEvaluation<2> evaluation = evaluateByLibrary(scene);
    if (evaluation.has_occlusion) continue;
    ++compared;
    const SceneEvaluation<2> sum = sumOfWholeSegments(scene);
    EXPECT_EQ(evaluation.derivatives.irradiance.value, sum.derivatives.irradiance.value);
    EXPECT_EQ(evaluation.derivatives.gradient.value, sum.derivatives.gradient.value);
    EXPECT_EQ(evaluation.derivatives.hessian.value, sum.derivatives.hessian.value);
  }
  EXPECT_GT(compared, lengthened(2000) / 20);
}

TEST(EvaluateScene, WhatIsNotSeenChangesNoBit) {
  for (std::size_t i = 0; i < lengthened(500); ++i) {
    KeyedRandom random(kSeed, "unseen", i);
    const FlatlandScene scene = smoothFamilies()[i % 2].draw(random);
    const SceneEvaluation<2> before = evaluateByLibrary(scene);
    const Eigen::Vector2d& n = scene.receiver.normal;
    const Eigen::Vector2d tangent(-n(1), n(0));
    const auto at = [&](double along, double height) {
      return Eigen::Vector2d(scene.receiver.position + along * tangent + height * n);
    };
    // Below the horizon, before the rest of the scene and behind it.
    for (const bool is_first : {false, true}) {
      FlatlandScene more = scene;
      const Segment below{"below", {at(random.between(-1.0, 1.0), -0.01), at(random.between(-9.0, 9.0), -3.0)}, 7.0};
      more.segments.insert(is_first ? more.segments.begin() : more.segments.end(), below);
      const SceneEvaluation<2> after = evaluateByLibrary(more);
      EXPECT_TRUE(sameBits(before, after)) << sceneLine(more);
      EXPECT_EQ(before.has_occlusion, after.has_occlusion);
    }
    // Behind all of a room.
    if (i % 2 == 1) {
      FlatlandScene more = scene;
      more.segments.push_back({"behind", {at(-9.0, 5.0), at(9.0, 6.0)}, 7.0});
      EXPECT_TRUE(sameBits(before, evaluateByLibrary(more))) << sceneLine(more);
      EXPECT_TRUE(evaluateByLibrary(more).has_occlusion);
    }
  }
}

TEST(EvaluateScene, SplittingASegmentChangesNothingBeyondTheBounds) {
  for (std::size_t i = 0; i < lengthened(500); ++i) {
    KeyedRandom random(kSeed, "split", i);
    FlatlandScene scene = smoothFamilies()[i % 2].draw(random);
    // Halves of a segment from a to a + 2 d are exact if the coordinates have few digits.
    for (Segment& segment : scene.segments) {
      for (Eigen::Vector2d& vertex : segment.vertices) vertex = vertex.cast<float>().cast<double>();
    }
    FlatlandScene split = scene;
    const std::size_t k = random.below(scene.segments.size());
    const Eigen::Vector2d middle = 0.5 * (scene.segments[k].vertices[0] + scene.segments[k].vertices[1]);
    split.segments[k].vertices[1] = middle;
    split.segments.push_back(scene.segments[k]);
    split.segments.back().vertices[0] = middle;
    const SceneEvaluation<2> one = evaluateByLibrary(scene);
    const SceneEvaluation<2> two = evaluateByLibrary(split);
    EXPECT_LE(std::abs(one.derivatives.irradiance.value - two.derivatives.irradiance.value),
              one.bounds.irradiance + two.bounds.irradiance);
    EXPECT_LE((one.derivatives.gradient.value - two.derivatives.gradient.value).cwiseAbs().maxCoeff(),
              one.bounds.gradient + two.bounds.gradient)
        << sceneLine(split);
    EXPECT_LE((one.derivatives.hessian.value - two.derivatives.hessian.value).cwiseAbs().maxCoeff(),
              one.bounds.hessian + two.bounds.hessian)
        << sceneLine(split);
    EXPECT_EQ(two.no_hessian, "");
  }
}

TEST(EvaluateScene, ARoomOfConstantRadianceIsConstantWhateverStandsInIt) {
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < lengthened(500); ++i) {
    KeyedRandom random(kSeed, "constant room", i);
    FlatlandScene scene = smoothFamilies()[1].draw(random);
    for (Segment& segment : scene.segments) segment.radiance = 1.5;
    const SceneEvaluation<2> evaluation = evaluateByLibrary(scene);
    hidden += evaluation.has_occlusion ? 1 : 0;
    // 2 |n| L.
    EXPECT_NEAR(evaluation.derivatives.irradiance.value, 3.0 * scene.receiver.normal.norm(),
                evaluation.bounds.irradiance + 3.0 * 0x1p-51);
    EXPECT_LE(evaluation.derivatives.gradient.value.cwiseAbs().maxCoeff(), evaluation.bounds.gradient);
    EXPECT_LE(evaluation.derivatives.hessian.value.cwiseAbs().maxCoeff(), evaluation.bounds.hessian);
  }
  EXPECT_GT(hidden, lengthened(500) / 2);
}

TEST(EvaluateScene, PowersOfTwoScaleItWithoutARounding) {
  for (std::size_t i = 0; i < lengthened(200); ++i) {
    KeyedRandom random(kSeed, "scaled", i);
    const FlatlandScene scene = smoothFamilies()[i % 2].draw(random);
    const SceneEvaluation<2> plain = evaluateByLibrary(scene);
    for (const int exponent : {-300, -1, 40, 300}) {
      FlatlandScene scaled = scene;
      const double factor = std::ldexp(1.0, exponent);
      for (Segment& segment : scaled.segments) {
        for (Eigen::Vector2d& vertex : segment.vertices) vertex *= factor;
      }
      scaled.receiver.position *= factor;
      const SceneEvaluation<2> evaluation = evaluateByLibrary(scaled);
      EXPECT_EQ(evaluation.derivatives.irradiance.value, plain.derivatives.irradiance.value);
      EXPECT_EQ(evaluation.derivatives.gradient.value * factor, plain.derivatives.gradient.value);
      EXPECT_EQ(evaluation.derivatives.hessian.value * factor * factor, plain.derivatives.hessian.value);
    }
  }
}

}  // namespace
}  // namespace irradiff
