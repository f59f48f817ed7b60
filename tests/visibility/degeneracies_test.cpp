// Each row of the table in docs/derivations/visibility.md, section 4.

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const Vector3d kUp(0.0, 0.0, 1.0);

Polygon rectangle(const std::string& name, double x0, double x1, double y0, double y1, double z, double radiance) {
  return {name, {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, radiance};
}

/// An upright rectangle in the plane x = `x`.
Polygon wall(const std::string& name, double x, double y0, double y1, double z0, double z1, double radiance) {
  return {name, {{x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}}, radiance};
}

SceneEvaluation<3> evaluate(const std::vector<Polygon>& scene, const Receiver& receiver) {
  return SceneEvaluator(scene).evaluate(receiver);
}

const Polygon kLamp = rectangle("lamp", -1.0, 1.0, -1.0, 1.0, 2.0, 1.0);
const Receiver kOrigin{{0.0, 0.0, 0.0}, kUp};

TEST(Degeneracies, AReceiverOnAnEdgeOrAVertexIsRefused) {
  const Polygon screen = rectangle("screen", -0.5, 0.5, -0.5, 0.5, 1.0, 0.0);
  EXPECT_THROW(evaluate({kLamp, screen}, {{0.5, 0.25, 1.0}, kUp}), InvalidScene);
  EXPECT_THROW(evaluate({kLamp, screen}, {{0.5, 0.5, 1.0}, kUp}), InvalidScene);
  EXPECT_NO_THROW(evaluate({kLamp, screen}, {{0.5, 0.25, 1.0 + 1e-15}, kUp}));
}

TEST(Degeneracies, TheReceiversOwnSurfaceIsNotThere) {
  const Polygon table = rectangle("table", -0.5, 0.5, -0.5, 0.5, 1.0, 3.0);
  const SceneEvaluation<3> on_table = evaluate({kLamp, table}, {{0.1, 0.2, 1.0}, kUp});
  EXPECT_EQ(on_table.derivatives.irradiance.value,
            evaluate({kLamp}, {{0.1, 0.2, 1.0}, kUp}).derivatives.irradiance.value);
  EXPECT_FALSE(on_table.has_occlusion);
  EXPECT_THROW(evaluate({kLamp, table}, {{0.1, 0.2, 1.0}, Vector3d(0.6, 0.0, 0.8)}), InvalidScene);
}

TEST(Degeneracies, AFaceSeenEdgeOnLeavesNoGradient) {
  const SceneEvaluation<3> sum = evaluate({kLamp, wall("wall", 0.0, -0.5, 0.5, 0.5, 1.5, 0.0)}, kOrigin);
  EXPECT_EQ(sum.derivatives.irradiance.value, evaluate({kLamp}, kOrigin).derivatives.irradiance.value);
  EXPECT_THAT(sum.no_gradient, AllOf(HasSubstr("\"wall\""), HasSubstr("edge-on")));
  EXPECT_THAT(sum.no_hessian, Not(IsEmpty()));
  EXPECT_THAT(sum.no_tangential_hessian, Not(IsEmpty()));
}

TEST(Degeneracies, AFaceSeenEdgeOnInHidingDoesNotCount) {
  const Polygon screen = rectangle("screen", -0.7, 0.8, -0.75, 0.85, 0.25, 0.0);
  const SceneEvaluation<3> sum = evaluate({kLamp, wall("wall", 0.0, -0.5, 0.5, 0.5, 1.5, 0.0), screen}, kOrigin);
  EXPECT_THAT(sum.no_gradient, IsEmpty());
  EXPECT_THAT(sum.no_hessian, IsEmpty());
  // Nor does one as bright as what it is seen against.
  EXPECT_THAT(evaluate({kLamp, wall("wall", 0.0, -0.1, 0.1, 0.5, 1.5, 1.0)}, kOrigin).no_gradient, IsEmpty());
}

TEST(Degeneracies, EdgesInLineLeaveNoGradient) {
  // The right edges of both screens, x = z / 4, lie over each other in view.
  const Polygon near = rectangle("near", -0.3, 0.25, -0.45, 0.42, 1.0, 0.0);
  const Polygon far = rectangle("far", -0.5, 0.375, -0.4, 0.4, 1.5, 0.5);
  const SceneEvaluation<3> in_line = evaluate({kLamp, near, far}, kOrigin);
  EXPECT_THAT(in_line.no_gradient, AllOf(HasSubstr("\"near\""), HasSubstr("\"far\"")));
  EXPECT_THAT(in_line.no_hessian, Not(IsEmpty()));
  const SceneEvaluation<3> beside = evaluate({kLamp, near, far}, {{1e-9, 0.0, 0.0}, kUp});
  EXPECT_THAT(beside.no_gradient, IsEmpty());
  // Irradiance is continuous: 1e-9 m change it by that times the gradient, with a factor of 2 for its change.
  EXPECT_NEAR(in_line.derivatives.irradiance.value, beside.derivatives.irradiance.value,
              2e-9 * beside.derivatives.gradient.value.norm() + 2.0 * beside.bounds.irradiance);
  // The gradients on both sides differ: the far screen's edge is seen on one and not on the other.
  const SceneEvaluation<3> other_side = evaluate({kLamp, near, far}, {{-1e-9, 0.0, 0.0}, kUp});
  EXPECT_GT(std::abs(beside.derivatives.gradient.value(0) - other_side.derivatives.gradient.value(0)), 1e-3);
}

TEST(Degeneracies, AVertexOnAForeignEdgeLeavesNoHessian) {
  // The near screen's corner (0.25, 0.1, 1) is seen on the far screen's edge x = 0.5 at z = 2 - that of the lamp.
  const Polygon lamp = rectangle("lamp", -1.0, 0.5, -1.0, 1.0, 2.0, 1.0);
  const Polygon near{"near", {{0.25, 0.1, 1.0}, {0.6, 0.4, 1.0}, {0.6, -0.3, 1.0}}, 0.0};
  const SceneEvaluation<3> sum = evaluate({lamp, near}, kOrigin);
  EXPECT_THAT(sum.no_gradient, IsEmpty());
  EXPECT_THAT(sum.no_hessian, AllOf(HasSubstr("\"lamp\""), HasSubstr("\"near\"")));
  EXPECT_THAT(sum.no_tangential_hessian, Not(IsEmpty()));
  const auto gradient = [&](double x) {
    return evaluate({lamp, near}, {{x, 0.0, 0.0}, kUp}).derivatives.gradient.value(0);
  };
  const auto hessian = [&](double x) {
    const SceneEvaluation<3> at = evaluate({lamp, near}, {{x, 0.0, 0.0}, kUp});
    EXPECT_THAT(at.no_hessian, IsEmpty());
    return at.derivatives.hessian.value(0, 0);
  };
  // The Hessian jumps, and the gradient changes by no more than 2e-9 m times the larger of its two values, twice that.
  EXPECT_GT(std::abs(hessian(-1e-9) - hessian(1e-9)), 1e-2);
  EXPECT_NEAR(gradient(-1e-9), gradient(1e-9), 4e-9 * std::max(std::abs(hessian(-1e-9)), std::abs(hessian(1e-9))));
}

TEST(Degeneracies, ThreeEdgesInOneDirectionLeaveNoHessian) {
  // Three screens whose edges pass over the direction (1/8, 1/8, 1) at three depths.
  const Polygon first{"first", {{0.0625, -0.3, 0.5}, {0.0625, 0.2, 0.5}, {0.6, 0.0, 0.5}}, 0.0};
  const Polygon second{"second", {{-0.7, 0.125, 1.0}, {0.9, 0.125, 1.0}, {0.0, 0.8, 1.0}}, 0.25};
  const Polygon third{"third", {{-0.25, 0.625, 1.5}, {0.625, -0.25, 1.5}, {-0.5, -0.45, 1.5}}, 0.5};
  const SceneEvaluation<3> sum = evaluate({kLamp, first, second, third}, kOrigin);
  EXPECT_THAT(sum.no_gradient, IsEmpty());
  EXPECT_THAT(sum.no_hessian, HasSubstr("third edge"));
  EXPECT_THAT(evaluate({kLamp, first, second, third}, {{1e-6, 2e-6, 0.0}, kUp}).no_hessian, IsEmpty());
  // A screen in front of the place hides the event.
  const Polygon cover = rectangle("cover", 0.02, 0.05, 0.03, 0.06, 0.3, 0.0);
  EXPECT_THAT(evaluate({kLamp, first, second, third, cover}, kOrigin).no_hessian, IsEmpty());
}

TEST(Degeneracies, TwoVerticesInOneDirectionLeaveNoHessian) {
  const Polygon near{"near", {{0.125, 0.0625, 1.0}, {0.45, 0.3, 1.0}, {0.47, -0.2, 1.0}}, 0.0};
  const Polygon far{"far", {{0.1875, 0.09375, 1.5}, {-0.5, 0.4, 1.5}, {-0.45, -0.35, 1.5}}, 0.0};
  EXPECT_THAT(evaluate({kLamp, near, far}, kOrigin).no_hessian, Not(IsEmpty()));
  EXPECT_THAT(evaluate({kLamp, near, far}, kOrigin).no_gradient, IsEmpty());
}

TEST(Degeneracies, AnEdgeTowardsTheReceiverLeavesNoHessian) {
  // An edge of the screen runs along the z axis.
  const Polygon screen{"screen", {{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}, {0.3, 0.1, 0.8}}, 0.0};
  EXPECT_THAT(evaluate({kLamp, screen}, kOrigin).no_hessian, Not(IsEmpty()));
}

TEST(Degeneracies, AnEdgeOnTheHorizonLeavesTheTangentialHessian) {
  const Polygon lit_wall = wall("lit wall", 1.5, -1.0, 1.0, 0.0, 1.0, 2.0);
  const SceneEvaluation<3> sum = evaluate({kLamp, lit_wall}, kOrigin);
  EXPECT_THAT(sum.no_hessian, AllOf(HasSubstr("\"lit wall\""), HasSubstr("one-sided")));
  EXPECT_THAT(sum.no_gradient, IsEmpty());
  EXPECT_THAT(sum.no_tangential_hessian, IsEmpty());
  // A black block that stands on the horizon in front of it as well; on black ground there is nothing to be seen below.
  const Polygon block = wall("block", 1.0, -0.3, 0.2, 0.0, 0.4, 0.0);
  EXPECT_THAT(evaluate({wall("deep wall", 1.5, -1.0, 1.0, -0.5, 1.0, 2.0), block}, kOrigin).no_hessian,
              HasSubstr("\"block\""));
  EXPECT_THAT(evaluate({kLamp, block}, kOrigin).no_hessian, IsEmpty());
}

TEST(Degeneracies, EdgesThatTouchInSpaceAreNoEvent) {
  // Two tiles side by side, and a third whose edge is half of theirs: a T-junction at (0, 0.2, 1).
  const std::vector<Polygon> tiles = {rectangle("left", -0.4, 0.0, -0.3, 0.5, 1.0, 0.5),
                                      rectangle("right below", 0.0, 0.4, -0.3, 0.2, 1.0, 0.75),
                                      rectangle("right above", 0.0, 0.4, 0.2, 0.5, 1.0, 0.25), kLamp};
  const SceneEvaluation<3> sum = evaluate(tiles, {{0.05, 0.1, 0.0}, kUp});
  EXPECT_THAT(sum.no_gradient, IsEmpty());
  EXPECT_THAT(sum.no_hessian, IsEmpty());
  EXPECT_EQ(sum.apparent_vertices, 0U);
}

TEST(Degeneracies, PolygonsThatPassThroughEachOtherMeetInACrease) {
  // A vertical slab through the lamp, seen from below: the part above the lamp is hidden by it, and what is below hides
  // a part of the lamp. So cutting the slab at the lamp's plane changes nothing.
  const std::vector<Polygon> crossed = {kLamp, wall("slab", 0.25, -0.5, 0.5, 1.5, 2.5, 0.5)};
  const std::vector<Polygon> cut = {kLamp, wall("slab", 0.25, -0.5, 0.5, 1.5, 2.0, 0.5)};
  for (const double x : {-0.5, 0.1, 0.7}) {
    const Receiver receiver{{x, 0.2, 0.0}, Vector3d(0.2, -0.1, 1.0).normalized()};
    const SceneEvaluation<3> a = evaluate(crossed, receiver);
    const SceneEvaluation<3> b = evaluate(cut, receiver);
    EXPECT_TRUE(a.has_occlusion);
    EXPECT_THAT(a.no_hessian, IsEmpty());
    EXPECT_NEAR(a.derivatives.irradiance.value, b.derivatives.irradiance.value,
                a.bounds.irradiance + b.bounds.irradiance);
    EXPECT_LE((a.derivatives.gradient.value - b.derivatives.gradient.value).cwiseAbs().maxCoeff(),
              a.bounds.gradient + b.bounds.gradient);
    EXPECT_LE((a.derivatives.hessian.value - b.derivatives.hessian.value).cwiseAbs().maxCoeff(),
              a.bounds.hessian + b.bounds.hessian);
    // And it is not what is seen without the slab.
    EXPECT_GT(std::abs(a.derivatives.irradiance.value - evaluate({kLamp}, receiver).derivatives.irradiance.value),
              1e-4);
  }
}

TEST(Degeneracies, AClosedRoomWithBlocksOfItsRadianceIsUniform) {
  // Faces, edges and vertices of a room and of a block that stands on its floor; the receiver on the floor.
  const auto box = [](const std::string& name, const Vector3d& low, const Vector3d& high) {
    std::vector<Polygon> faces;
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        Polygon face{name, {}, 2.0};
        for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          Vector3d p;
          p(axis) = upper ? high(axis) : low(axis);
          p((axis + 1) % 3) = u == 1 ? high((axis + 1) % 3) : low((axis + 1) % 3);
          p((axis + 2) % 3) = v == 1 ? high((axis + 2) % 3) : low((axis + 2) % 3);
          face.vertices.push_back(p);
        }
        faces.push_back(face);
      }
    }
    return faces;
  };
  std::vector<Polygon> scene = box("room", {-1.0, -1.0, 0.0}, {1.0, 1.0, 1.5});
  for (Polygon& face : box("block", {0.25, 0.0, 0.0}, {0.75, 0.5, 0.5})) scene.push_back(face);
  for (const Vector3d& position : {Vector3d(0.1, 0.2, 0.0), Vector3d(-0.5, -0.25, 0.0), Vector3d(0.5, -0.25, 0.0)}) {
    const SceneEvaluation<3> sum = evaluate(scene, {position, kUp});
    EXPECT_TRUE(sum.has_occlusion);
    // 2 pi in double is off by less than an ulp.
    EXPECT_NEAR(sum.derivatives.irradiance.value, 2.0 * std::numbers::pi, sum.bounds.irradiance + 0x1p-50);
    EXPECT_LE(sum.derivatives.gradient.value.cwiseAbs().maxCoeff(), sum.bounds.gradient);
    EXPECT_THAT(sum.no_gradient, IsEmpty());
    EXPECT_LE(sum.derivatives.tangential_hessian.value.cwiseAbs().maxCoeff(), sum.bounds.tangential_hessian);
  }
}

}  // namespace
}  // namespace irradiff
