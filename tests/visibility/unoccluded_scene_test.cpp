#include "derivatives/visibility/unoccluded_scene.h"

#include "derivatives/scene/invalid_scene.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

const Vector3d kUp(0.0, 0.0, 1.0);

Polygon squareAt(const std::string& name, double height, double half_width, double radiance, double shift = 0.0) {
  return {name,
          {{shift - half_width, -half_width, height},
           {shift + half_width, -half_width, height},
           {shift + half_width, half_width, height},
           {shift - half_width, half_width, height}},
          radiance};
}

std::vector<Polygon> cube(double radiance) {
  std::vector<Polygon> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Polygon face{"face", {}, radiance};
      for (const auto& [u, v] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        Vector3d p;
        p(axis) = side;
        p((axis + 1) % 3) = u;
        p((axis + 2) % 3) = v;
        face.vertices.push_back(p);
      }
      faces.push_back(face);
    }
  }
  return faces;
}

std::vector<Polygon> moved(std::vector<Polygon> scene, const Eigen::Isometry3d& motion) {
  for (Polygon& polygon : scene) {
    for (Vector3d& v : polygon.vertices) {
      v = motion * v;
    }
  }
  return scene;
}

std::string overlapMessage(const std::vector<Polygon>& scene, const Receiver& receiver) {
  try {
    evaluateUnoccluded(scene, receiver);
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "";
}

TEST(EvaluateUnoccluded, ClosedBoxOfConstantRadiance) {
  const Receiver receiver{{0.1, 0.2, 0.3}, Vector3d(2.0, 3.0, 6.0) / 7.0};
  const SceneEvaluation<3> sum = evaluateUnoccluded(cube(2.0), receiver);
  EXPECT_NEAR(sum.derivatives.irradiance.value, 2.0 * std::numbers::pi, sum.bounds.irradiance + 1e-15);
  EXPECT_LE(sum.derivatives.gradient.value.cwiseAbs().maxCoeff(), sum.bounds.gradient);
  EXPECT_LE(sum.derivatives.hessian.value.cwiseAbs().maxCoeff(), sum.bounds.hessian);
  EXPECT_TRUE(sum.crosses_horizon);
}

TEST(EvaluateUnoccluded, FacesOfATurnedAndMovedBoxOnlyTouch) {
  for (int i = 0; i < 50; ++i) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.rotate(Eigen::AngleAxisd(0.1 + 0.13 * i, Vector3d(1.0, i, 2.0).normalized()));
    motion.pretranslate(Vector3d(1000.0 * i, -300.0, 5.0));
    const Receiver receiver{motion * Vector3d(0.3, -0.2, 0.1),
                            (motion.linear() * Vector3d(0.0, 0.6, 0.8)).normalized()};
    EXPECT_NO_THROW(evaluateUnoccluded(moved(cube(1.0), motion), receiver)) << i;
  }
}

TEST(EvaluateUnoccluded, RefusesAPolygonInFrontOfAnother) {
  const std::vector<Polygon> scene = {squareAt("lamp", 2.0, 1.0, 5.0), squareAt("blocker", 1.0, 0.1, 0.0)};
  EXPECT_THAT(overlapMessage(scene, {{0.0, 0.0, 0.0}, kUp}),
              AllOf(HasSubstr("polygons[0] \"lamp\""), HasSubstr("polygons[1] \"blocker\""), HasSubstr("occlusion")));
  // From the side the blocker is clear of the lamp.
  EXPECT_EQ(overlapMessage(scene, {{6.0, 0.0, 0.0}, kUp}), "");
}

TEST(EvaluateUnoccluded, RefusesWhatASheetHidesThatTheReceiverAllButTouches) {
  // The sheet fills the view; its vertices are in the receiver's plane up to the rounding of coordinates.
  for (const double shift : {0.0, 1.0, 1e3, 1e6}) {
    for (const double radiance : {0.0, 1.0}) {
      for (double height = 1e-16; height < 1e-6; height *= 2.0) {
        Polygon sheet = squareAt("sheet", 0.0, 0.5, radiance);
        Polygon lamp = squareAt("lamp", 1.0, 0.5, 1.0);
        for (Polygon* polygon : {&sheet, &lamp}) {
          for (Vector3d& v : polygon->vertices) {
            v(0) += shift;
          }
        }
        const std::string message = overlapMessage({sheet, lamp}, {{shift + 0.125, -0.25, -height}, kUp});
        EXPECT_THAT(message, AllOf(HasSubstr("\"sheet\""), HasSubstr("\"lamp\""))) << shift << ' ' << height;
      }
    }
  }
}

TEST(EvaluateUnoccluded, RefusesDuplicatesAndEnclosedPolygons) {
  const Polygon lamp = squareAt("lamp", 2.0, 1.0, 5.0);
  EXPECT_NE(overlapMessage({lamp, lamp}, {{0.1, 0.0, 0.0}, kUp}), "");
  EXPECT_NE(overlapMessage({lamp, squareAt("inner", 2.0, 0.5, 1.0)}, {{0.1, 0.0, 0.0}, kUp}), "");
}

TEST(EvaluateUnoccluded, FollowsANonConvexOutline) {
  // An L with a square in its notch, and then one that reaches into it.
  const Polygon ell{"ell", {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}}, 1.0};
  Polygon notch{"notch", {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}}, 1.0};
  const Receiver receiver{{0.8, 0.9, 0.0}, kUp};
  EXPECT_EQ(overlapMessage({ell, notch}, receiver), "");
  notch.vertices[0] = Vector3d(0.9, 0.9, 1.0);
  EXPECT_NE(overlapMessage({ell, notch}, receiver), "");
}

TEST(EvaluateUnoccluded, TurnedFillingsOfANonConvexOutlineOnlyTouch) {
  // Vertices that rounding puts off a line that they were on: the corner of the L is on the diagonal between its ends,
  // those of the comb are on lines with each other. Receivers above, beside and close to shared corners.
  const std::vector<Polygon> ell = {{"ell", {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}}, 1.0},
                                    {"notch", {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}}, 1.0}};
  const std::vector<Polygon> comb = {
      {"comb",
       {{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {1.6, 2, 1}, {1.6, 0.4, 1}, {1.2, 0.4, 1}, {1.2, 2, 1}, {0, 2, 1}},
       1.0},
      {"gap", {{1.2, 0.4, 1}, {1.6, 0.4, 1}, {1.6, 2, 1}, {1.2, 2, 1}}, 1.0}};
  for (int i = 0; i < 200; ++i) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.rotate(Eigen::AngleAxisd(0.1 + 0.031 * i, Vector3d(1.0, 0.1 * i, 2.0).normalized()));
    motion.pretranslate(Vector3d(i % 3, 100.0 * (i % 2), -1.0));
    const Vector3d normal = Vector3d(std::sin(0.7 * i), std::cos(1.3 * i), 0.3).normalized();
    const Vector3d position = i % 4 == 0 ? Vector3d(1.0, 1.0 + 1e-7, 1.0 - 1e-6) : Vector3d(0.013 * i, 1.2, 0.0);
    const Receiver receiver{motion * position, (motion.linear() * normal).normalized()};
    EXPECT_EQ(overlapMessage(moved(ell, motion), receiver), "") << i;
    EXPECT_EQ(overlapMessage(moved(comb, motion), receiver), "") << i;
  }
}

TEST(EvaluateUnoccluded, BlackPolygonsMayHideEachOther) {
  const std::vector<Polygon> scene = {squareAt("a", 1.0, 0.5, 0.0), squareAt("b", 2.0, 0.5, 0.0)};
  EXPECT_EQ(overlapMessage(scene, {{0.0, 0.0, 0.0}, kUp}), "");
}

TEST(EvaluateUnoccluded, BlackScreenSeenEdgeOnLeavesNoDerivative) {
  // It hides nothing from here and half of the lamp from either side.
  const Polygon screen{"screen", {{0, -0.2, 0.5}, {0, 0.2, 0.5}, {0, 0.2, 1.0}, {0, -0.2, 1.0}}, 0.0};
  const auto sum = evaluateUnoccluded(std::vector{squareAt("lamp", 2.0, 1.0, 1.0), screen}, {{0.0, 0.0, 0.0}, kUp});
  EXPECT_GT(sum.derivatives.irradiance.value, 0.0);
  EXPECT_THAT(sum.no_gradient, AllOf(HasSubstr("polygons[1] \"screen\""), HasSubstr("edge-on")));
  EXPECT_FALSE(sum.no_tangential_hessian.empty());
}

TEST(EvaluateUnoccluded, WhatIsBelowTheHorizonHidesNothing) {
  const std::vector<Polygon> scene = {squareAt("lamp", 2.0, 1.0, 5.0), squareAt("floor", -1.0, 0.5, 0.0),
                                      squareAt("deep", -2.0, 3.0, 1.0)};
  EXPECT_EQ(overlapMessage(scene, {{0.0, 0.0, 0.0}, kUp}), "");
}

TEST(EvaluateUnoccluded, RadianceScalesAndSourcesAdd) {
  const Receiver receiver{{0.0, 0.0, 0.0}, kUp};
  const Polygon left = squareAt("left", 2.0, 0.5, 3.0, -1.0);
  const Polygon right = squareAt("right", 2.0, 0.5, 4.0, 1.0);
  const auto both = evaluateUnoccluded(std::vector{left, right}, receiver);
  const auto first = evaluateUnoccluded(std::vector{left}, receiver);
  const auto second = evaluateUnoccluded(std::vector{right}, receiver);
  EXPECT_NEAR(both.derivatives.irradiance.value,
              first.derivatives.irradiance.value + second.derivatives.irradiance.value, both.bounds.irradiance);
  EXPECT_LE((both.derivatives.hessian.value - first.derivatives.hessian.value - second.derivatives.hessian.value)
                .cwiseAbs()
                .maxCoeff(),
            both.bounds.hessian);
  // The brighter lamp pulls the gradient to its side.
  EXPECT_GT(both.derivatives.gradient.value(0), 0.0);
}

}  // namespace
}  // namespace irradiff
