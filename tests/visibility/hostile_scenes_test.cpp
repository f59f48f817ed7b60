// Scenes found by random search that were once evaluated wrongly, each the smallest that shows its defect. Irradiance
// is held to an integral over slices that knows no edges, derivatives to differences of what is evaluated beside.

#include "derivatives/visibility/scene_evaluation.h"
#include "tests/visibility/slice_integral.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::Eq;
using testing::IsEmpty;
using testing::Not;

const Vector3d kUp(0.0, 0.0, 1.0);
const Vector3d kTilted(0.0, -0.6, 0.8);
const Vector3d kOblique(2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0);

using Scene = std::vector<Polygon>;

Polygon polygon(double radiance, std::vector<Vector3d> vertices) { return {"", std::move(vertices), radiance}; }

SceneEvaluation<3> evaluate(const Scene& scene, const Receiver& receiver) {
  return SceneEvaluator(scene).evaluate(receiver);
}

/// The scene in every order of its polygons, each polygon run through in both directions. The order in which a mesh
/// comes to know points and edges must not matter.
std::vector<Scene> reordered(const Scene& scene) {
  std::vector<std::size_t> order(scene.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::vector<Scene> all;
  do {
    for (const bool is_reversed : {false, true}) {
      Scene& one = all.emplace_back();
      for (const std::size_t i : order) {
        one.push_back(scene[i]);
        if (is_reversed) std::ranges::reverse(one.back().vertices);
      }
    }
  } while (std::ranges::next_permutation(order).found);
  return all;
}

void expectIrradianceOfSlices(const Scene& scene, const Receiver& receiver) {
  const SliceIntegral slices = irradianceBySlices(scene, receiver);
  // The integral over slices is no use if it does not know better than what it is to find.
  ASSERT_LT(slices.error, 1e-8);
  for (const Scene& one : reordered(scene)) {
    const SceneEvaluation<3> sum = evaluate(one, receiver);
    EXPECT_NEAR(sum.derivatives.irradiance.value, slices.irradiance, sum.bounds.irradiance + slices.error);
  }
}

/// Directions in which a receiver is moved off a degenerate place.
std::vector<Vector3d> aside() {
  std::vector<Vector3d> directions;
  for (int i = 0; i < 12; ++i) {
    const double turn = 0.37 + 2.4 * i;
    const double height = (i - 5.5) / 6.5;
    const double radius = std::sqrt(1.0 - height * height);
    directions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), height);
  }
  return directions;
}

/// Gradients or Hessians beside a receiver, 1e-7 away, where they exist.
template <class Value>
std::vector<Value> beside(const Scene& scene, const Receiver& receiver) {
  constexpr double kStep = 1e-7;
  const SceneEvaluator evaluator(scene);
  std::vector<Value> values;
  for (const Vector3d& direction : aside()) {
    const SceneEvaluation<3> sum = evaluator.evaluate({receiver.position + kStep * direction, receiver.normal});
    if constexpr (std::is_same_v<Value, Vector3d>) {
      if (sum.no_gradient.empty()) values.push_back(sum.derivatives.gradient.value);
    } else {
      if (sum.no_hessian.empty()) values.push_back(sum.derivatives.hessian.value);
    }
  }
  return values;
}

template <class Value>
double spread(const std::vector<Value>& values) {
  double largest = 0.0;
  for (const Value& a : values) {
    for (const Value& b : values) largest = std::max(largest, (a - b).cwiseAbs().maxCoeff());
  }
  return largest;
}

/// The gradient jumps at the receiver, and none is claimed in any order of the polygons.
void expectNoGradient(const Scene& scene, const Receiver& receiver) {
  EXPECT_GT(spread(beside<Vector3d>(scene, receiver)), 1e-3) << "the scene shows no event";
  for (const Scene& one : reordered(scene)) EXPECT_THAT(evaluate(one, receiver).no_gradient, Not(IsEmpty()));
}

/// The Hessian jumps at the receiver, and none is claimed in any order of the polygons; the gradient is.
void expectNoHessian(const Scene& scene, const Receiver& receiver) {
  EXPECT_GT(spread(beside<Matrix3d>(scene, receiver)), 1e-3) << "the scene shows no event";
  for (const Scene& one : reordered(scene)) {
    EXPECT_THAT(evaluate(one, receiver).no_gradient, IsEmpty());
    EXPECT_THAT(evaluate(one, receiver).no_hessian, Not(IsEmpty()));
  }
}

/// The gradient and what it is beside the receiver.
void expectContinuousGradient(const Scene& scene, const Receiver& receiver) {
  for (const Scene& one : reordered(scene)) {
    const SceneEvaluation<3> sum = evaluate(one, receiver);
    ASSERT_THAT(sum.no_gradient, IsEmpty());
    const std::vector<Vector3d> around = beside<Vector3d>(one, receiver);
    ASSERT_GE(around.size(), 8U);
    for (const Vector3d& gradient : around) {
      EXPECT_LE((gradient - sum.derivatives.gradient.value).cwiseAbs().maxCoeff(), 1e-5);
    }
  }
}

// Two edges in one plane of view whose order in depth changes where they pass through each other.
TEST(HostileScenes, EdgesInLineThatPassThroughEachOther) {
  expectIrradianceOfSlices(
      {polygon(3.0, {{2, -1, -1}, {1, 1, 3}, {2, -2, -1}}), polygon(3.0, {{0, -2, 2}, {0, -2, 1}, {2, 2, 3}}),
       polygon(0.0, {{-1, -2, 0}, {2, -2, 1}, {1, -1, 1}})},
      {{2.0, -1.0, 0.0}, kOblique});
  expectIrradianceOfSlices(
      {polygon(1.0, {{-2, 1, -1}, {2, -1, 2}, {-1, 1, 0}}), polygon(1.0, {{1, 0, 3}, {-1, 1, 0}, {2, 2, 1}}),
       polygon(3.0, {{-1, -1, 1}, {2, -2, -1}, {0, 2, 3}})},
      {{1.0, 1.0, 0.0}, kUp});
  expectIrradianceOfSlices(
      {polygon(1.0, {{0, 0, 1}, {2, 0, 1}, {-2, 2, -1}}), polygon(1.0, {{-1, -2, -1}, {2, 1, 2}, {0, 2, 3}})},
      {{0.5, -1.0, 0.0}, kTilted});
}

// Several arcs end in one direction of the horizon.
TEST(HostileScenes, ArcsThatMeetOnTheHorizon) {
  expectIrradianceOfSlices(
      {polygon(1.0, {{1, 1, -1}, {2, 2, 3}, {2, -1, -1}}), polygon(3.0, {{2, -1, -1}, {1, 0, 2}, {-2, 1, 0}}),
       polygon(1.0, {{2, 1, 0}, {-2, 0, 3}, {0, 0, 0}})},
      {{0.5, -0.5, -1.0}, kUp});
}

// An apparent vertex exactly on the horizon, whose term is 0 times infinity.
TEST(HostileScenes, AnApparentVertexOnTheHorizon) {
  const Scene scene{polygon(3.0, {{-2, 5, -3}, {-1, 1, 4}, {-1, 3, 0}}),
                    polygon(3.0, {{-1, 2, -1}, {-2, 2, 2}, {0, 2, 0}})};
  const Receiver receiver{{-1.0, 1.0, -1.0}, kTilted};
  expectIrradianceOfSlices(scene, receiver);
  const SceneEvaluation<3> sum = evaluate(scene, receiver);
  EXPECT_TRUE(std::isfinite(sum.bounds.hessian));
  EXPECT_TRUE(sum.derivatives.hessian.value.allFinite());
}

// A receiver 1e-12 beside a line of degenerate places: cuts of cuts, low above the horizon.
TEST(HostileScenes, HeightsOfCutsKeepTheirDigits) {
  const Scene scene{polygon(3.0, {{-1, -2, 2}, {-1, 2, -2}, {-2, 2, -2}}),
                    polygon(0.0, {{-1, 1, -1}, {2, 2, -2}, {-1, 2, -2}})};
  const Receiver receiver{{-1.0000000000008376, 0.99999999999361988, -1.0000000000051041},
                          {0.66666666666429331, 0.33333333333842674, 0.66666666666649332}};
  const SceneEvaluation<3> sum = evaluate(scene, receiver);
  ASSERT_THAT(sum.no_gradient, IsEmpty());
  for (const Scene& one : reordered(scene)) {
    const SceneEvaluation<3> other = evaluate(one, receiver);
    EXPECT_LE((other.derivatives.gradient.value - sum.derivatives.gradient.value).cwiseAbs().maxCoeff(),
              other.bounds.gradient + sum.bounds.gradient);
  }
}

// A black polygon that hides nothing, farther away than the square of any number in the scene is exact.
TEST(HostileScenes, APolygonFarAwayChangesNoBit) {
  const Scene scene{polygon(1.0, {{-1, -1, 2}, {1.2, -1, 2}, {1, 1, 2}, {-1, 1.1, 2}}),
                    polygon(0.0, {{-0.3, -0.2, 1}, {0.4, -0.3, 1}, {0.3, 1.5, 1.25}}),
                    polygon(2.0, {{-0.5, -0.5, 1.5}, {0.7, -0.4, 3}, {0.6, 0.9, 1.6}}),
                    polygon(1.0, {{-0.5, -0.5, 2.5}, {0.7, -0.4, 1.1}, {0.6, 0.9, 2.6}})};
  const Receiver receiver{{0.0, 0.0, 0.0}, {0.0, 0.6, 0.8}};
  const SceneEvaluation<3> alone = evaluate(scene, receiver);
  ASSERT_GT(alone.apparent_vertices, 0U);
  for (const int exponent : {10, 250, 260, 270}) {
    const double far = std::ldexp(1.0, exponent);
    Scene extended = scene;
    extended.push_back(polygon(0.0, {{far, far, 4 * far}, {2 * far, far, 4 * far}, {far, 2 * far, 4 * far}}));
    const SceneEvaluation<3> sum = evaluate(extended, receiver);
    EXPECT_THAT(sum.derivatives.irradiance.value, Eq(alone.derivatives.irradiance.value)) << exponent;
    EXPECT_THAT(sum.derivatives.gradient.value, Eq(alone.derivatives.gradient.value)) << exponent;
    EXPECT_THAT(sum.derivatives.hessian.value, Eq(alone.derivatives.hessian.value)) << exponent;
    EXPECT_THAT(sum.bounds.hessian, Eq(alone.bounds.hessian)) << exponent;
  }
}

// Edges in line, both in front of the background: between them comes to be seen what none of them shows now.
TEST(HostileScenes, EdgesInLineOnTheSameSide) {
  expectNoGradient(
      {polygon(1.0, {{0, 2, 2}, {0, -3, 2}, {-1, -3, 2}}), polygon(1.0, {{-1, 3, 3}, {0, 2, 3}, {-1, 2, 3}})},
      {{2.0, 0.0, 0.0}, kUp});
}

// The far edge is a silhouette: of its two faces, on the same side, the nearer shows between the edges in line.
TEST(HostileScenes, ASilhouetteInLine) {
  expectNoGradient({polygon(1.0, {{-4, 2, 2}, {3, 2, 2}, {-4, 3, 2}}), polygon(2.0, {{1, 3, 3}, {0, 3, 3}, {0, 3, 1}}),
                    polygon(0.0, {{0, 3, 3}, {1, 3, 3}, {0, 4, 3}})},
                   {{-0.5, 0.0, 0.0}, kUp});
}

// A nearer edge lies over a part of the edge that two polygons of equal radiance share: smooth, but what bounds the
// polygon beside it there is the nearer edge.
TEST(HostileScenes, ANearerEdgeOverASharedOne) {
  expectContinuousGradient(
      {polygon(3.0, {{4, 2, 1}, {-3, 2, 2}, {-3, 2, 1}}), polygon(3.0, {{-3, 3, 2}, {4, 3, 2}, {4, 3, 1}}),
       polygon(3.0, {{4, 2, 2}, {4, 3, 2}, {-3, 3, 2}})},
      {{-1.0, 1.0, 0.0}, kUp});
  expectContinuousGradient(
      {polygon(1.0, {{2, -2, 3}, {2, 1, 6}, {1, 1, 6}}), polygon(1.0, {{1, 1, 6}, {2, 1, 6}, {1, 2, 7}}),
       polygon(0.0, {{-1, 1, 1}, {1, 1, 1}, {-1, 3, 1}})},
      {{-1.0, 1.0, -2.0}, kUp});
}

// Two faces touch in the direction of an event behind them, and open there.
TEST(HostileScenes, AnEventBehindFacesThatTouch) {
  expectNoHessian({polygon(3.0, {{3, 3, -2}, {1, 3, 2}, {3, 3, 2}}), polygon(0.0, {{1, 4, 0}, {3, -2, 3}, {1, -1, 1}})},
                  {{1.0, -1.0, -1.0}, kUp});
}

// A vertex of a notch, hidden by a face of the same radiance: once it comes out, the background shows.
TEST(HostileScenes, ANotchBehindAnEdge) {
  expectNoHessian({polygon(1.0, {{4, -4, 4}, {2, -2, 1}, {0, 0, 0}, {3, -3, 1}}),
                   polygon(1.0, {{1, 0, -3}, {-1, 0, 1}, {4, 0, 2}})},
                  {{-1.0, 0.5, -0.5}, kUp});
}

TEST(HostileScenes, BlackOnTheHorizon) {
  // An edge of a black polygon on the horizon, in front of a polygon that reaches it.
  expectNoHessian({polygon(2.0, {{0, 6, 1}, {3, 1, 0}, {-1, 1, -2}}), polygon(0.0, {{2, 1, 0}, {-1, 2, 0}, {0, 5, 0}})},
                  {{-2.0, 2.0, 0.0}, kUp});
  // A crease on the horizon.
  expectNoHessian(
      {polygon(0.0, {{0, -2, 3}, {-1, -2, 3}, {2, 3, -2}}), polygon(1.0, {{0, 1, 2}, {3, -3, -2}, {1, -1, 0}})},
      {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
}

// A polygon of which nothing is seen hangs down from an edge on the horizon: black in front of a lamp, lit in the open.
TEST(HostileScenes, HangingFromTheHorizon) {
  expectNoHessian({polygon(2.0, {{1, -2, 1}, {1, 2, 1}, {-2, 2, 1}}),
                   polygon(0.0, {{-2, 1, -2}, {0, 1, 2}, {-1, 4, 3}, {2, -2, 3}})},
                  {{1.0, 1.0, 0.5}, {0.0, 1.0, 0.0}});
  expectNoHessian({polygon(0.0, {{0, 3, 3}, {-2, 3, 3}, {-2, 1.5, 3}}),
                   polygon(1.0, {{-4, 0, 2}, {-1, 0, 2}, {-1, 3, 5}, {-3, 1, 3}, {-3, 2, 4}, {-4, 2, 4}})},
                  {{-2.0, 2.0, 2.0}, {0.0, 1.0, 0.0}});
}

// Three tiles whose corners meet in T-junctions are one surface.
TEST(HostileScenes, TilesWithTJunctions) {
  const Scene tiles{polygon(1.0, {{-2, -2, 3}, {0, -2, 3}, {0, 2, 3}, {-2, 2, 3}}),
                    polygon(2.0, {{0, -2, 3}, {2, -2, 3}, {2, 0.5, 3}, {0, 0.5, 3}}),
                    polygon(2.0, {{0, 0.5, 3}, {2, 0.5, 3}, {2, 2, 3}, {0, 2, 3}})};
  const Receiver receiver{{0.1, 0.2, 0.0}, kUp};
  for (const Scene& one : reordered(tiles)) EXPECT_FALSE(evaluate(one, receiver).has_occlusion);
  Scene scene = tiles;
  scene.push_back(polygon(0.0, {{-0.5, -1, 1}, {0.7, -1, 1}, {0.6, -0.2, 1}, {-0.5, -0.15, 1}}));
  expectIrradianceOfSlices(scene, receiver);
  constexpr double kStep = 1e-4;
  for (const Scene& one : reordered(scene)) {
    const SceneEvaluator evaluator(one);
    const SceneEvaluation<3> sum = evaluator.evaluate(receiver);
    ASSERT_THAT(sum.no_hessian, IsEmpty());
    for (int k = 0; k < 3; ++k) {
      const auto gradientAt = [&](double step) {
        return evaluator.evaluate({receiver.position + step * Vector3d::Unit(k), receiver.normal})
            .derivatives.gradient.value;
      };
      const auto difference = [&](double step) -> Vector3d {
        return (gradientAt(step) - gradientAt(-step)) / (2.0 * step);
      };
      // Richardson's extrapolation; the correction it makes bounds what is left.
      const Vector3d coarse = difference(2.0 * kStep);
      const Vector3d fine = difference(kStep);
      const Vector3d error = fine + (fine - coarse) / 3.0 - sum.derivatives.hessian.value.col(k);
      EXPECT_LE(error.cwiseAbs().maxCoeff(), (fine - coarse).cwiseAbs().maxCoeff() + 1e-9);
    }
  }
}

// Two triangles that share a line: which of them is seen whole must not depend on the order.
TEST(HostileScenes, OcclusionWithASharedLine) {
  const Scene scene{polygon(0.0, {{1, 3, 1}, {3, -1, 1}, {1, -1, 1}}), polygon(0.0, {{1, 1, 1}, {1, 3, 1}, {1, 1, 3}})};
  const Receiver receiver{{-0.5, 0.5, 1.0}, {0.6, 0.0, 0.8}};
  const bool has_occlusion = evaluate(scene, receiver).has_occlusion;
  for (const Scene& one : reordered(scene)) EXPECT_EQ(evaluate(one, receiver).has_occlusion, has_occlusion);
}

// What is seen of a lamp cancels to less than the errors of its parts.
TEST(HostileScenes, IrradianceIsNotNegative) {
  const Scene scene{polygon(2.0, {{3, 1, -2}, {1, -2, 0}, {1, -3, 0}, {2, -1, -1}}),
                    polygon(0.0, {{2, -0.5, -1}, {0, -1, 4}, {-2, -1, 3}})};
  const Receiver receiver{{2.0000000003502194, 1.0000000005138094, 4.4068263859338159e-10},
                          {-5.1337561886253109e-10, -2.7334097609493444e-10, 1.0}};
  for (const Scene& one : reordered(scene)) EXPECT_GE(evaluate(one, receiver).derivatives.irradiance.value, 0.0);
}

}  // namespace
}  // namespace irradiff
