#include "derivatives/visibility/scene_evaluation.h"

#include "derivatives/scene/invalid_scene.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
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

SceneEvaluation<3> evaluateScene(const std::vector<Polygon>& scene, const Receiver& receiver) {
  return SceneEvaluator(scene).evaluate(receiver);
}

std::string refusalOf(const std::vector<Polygon>& scene, const Receiver& receiver) {
  try {
    evaluateScene(scene, receiver);
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "";
}

TEST(SceneEvaluator, ClosedBoxOfConstantRadiance) {
  const Receiver receiver{{0.1, 0.2, 0.3}, Vector3d(2.0, 3.0, 6.0) / 7.0};
  const SceneEvaluation<3> sum = evaluateScene(cube(2.0), receiver);
  EXPECT_NEAR(sum.derivatives.irradiance.value, 2.0 * std::numbers::pi, sum.bounds.irradiance + 1e-15);
  EXPECT_LE(sum.derivatives.gradient.value.cwiseAbs().maxCoeff(), sum.bounds.gradient);
  EXPECT_LE(sum.derivatives.hessian.value.cwiseAbs().maxCoeff(), sum.bounds.hessian);
  EXPECT_TRUE(sum.crosses_horizon);
}

TEST(SceneEvaluator, FacesOfATurnedAndMovedBoxOnlyTouch) {
  for (int i = 0; i < 50; ++i) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.rotate(Eigen::AngleAxisd(0.1 + 0.13 * i, Vector3d(1.0, i, 2.0).normalized()));
    motion.pretranslate(Vector3d(1000.0 * i, -300.0, 5.0));
    const Receiver receiver{motion * Vector3d(0.3, -0.2, 0.1),
                            (motion.linear() * Vector3d(0.0, 0.6, 0.8)).normalized()};
    EXPECT_NO_THROW(evaluateScene(moved(cube(1.0), motion), receiver)) << i;
  }
}

TEST(SceneEvaluator, TakesAwayWhatABlackScreenHides) {
  // The screen's form factor times the lamp's radiance is what is lost.
  const Polygon lamp = squareAt("lamp", 2.0, 1.0, 5.0);
  const Polygon screen = squareAt("screen", 1.0, 0.1, 0.0);
  const Polygon lit_screen = squareAt("screen", 1.0, 0.1, 5.0);
  const Receiver below{{0.05, -0.02, 0.0}, kUp};
  const SceneEvaluation<3> screened = evaluateScene({lamp, screen}, below);
  const SceneEvaluation<3> whole = evaluateScene({lamp}, below);
  const SceneEvaluation<3> lost = evaluateScene({lit_screen}, below);
  EXPECT_TRUE(screened.has_occlusion);
  EXPECT_EQ(screened.apparent_vertices, 0U);
  EXPECT_NEAR(screened.derivatives.irradiance.value,
              whole.derivatives.irradiance.value - lost.derivatives.irradiance.value,
              screened.bounds.irradiance + whole.bounds.irradiance + lost.bounds.irradiance);
  EXPECT_LE((screened.derivatives.hessian.value + lost.derivatives.hessian.value - whole.derivatives.hessian.value)
                .cwiseAbs()
                .maxCoeff(),
            screened.bounds.hessian + whole.bounds.hessian + lost.bounds.hessian);
  // From the side the screen is clear of the lamp.
  const Receiver beside{{6.0, 0.0, 0.0}, kUp};
  const SceneEvaluation<3> clear = evaluateScene({lamp, screen}, beside);
  EXPECT_FALSE(clear.has_occlusion);
  EXPECT_EQ(clear.derivatives.irradiance.value, evaluateScene({lamp}, beside).derivatives.irradiance.value);
}

/// In the order of the fields.
std::array<std::size_t, 8> countsOf(const SourceCounts& c) {
  return {c.own_surface, c.below_horizon, c.edge_on, c.hidden, c.black, c.partly_hidden, c.boundary, c.area_rule};
}

TEST(SceneEvaluator, CountsWhatBecameOfEachPolygon) {
  const Polygon floor = squareAt("floor", 0.0, 3.0, 1.0);
  const Polygon cellar = squareAt("cellar", -1.0, 3.0, 1.0);
  const Polygon fin{"fin", {{-5.0, 0.0, 4.0}, {-6.0, 0.0, 4.0}, {-6.0, 0.0, 5.0}}, 1.0};
  const Polygon lamp = squareAt("lamp", 2.0, 1.0, 5.0);
  const Polygon screen = squareAt("screen", 1.0, 0.1, 0.0);
  const Polygon behind = squareAt("behind", 1.5, 0.01, 9.0);
  Polygon window = squareAt("window", 2.0, 1.0, 5.0);
  Polygon star = squareAt("star", 50.0, 0.1, 7.0);
  for (Vector3d& v : window.vertices) v.x() += 9.0;
  for (Vector3d& v : star.vertices) v.y() += 70.0;
  const Receiver receiver{{0.0, 0.0, 0.0}, kUp};
  const std::vector<Polygon> scene = {floor, cellar, fin, lamp, screen, behind, window, star};
  using Counts = std::array<std::size_t, 8>;
  EXPECT_EQ(countsOf(evaluateScene(scene, receiver).sources.value()), Counts({1, 1, 1, 1, 1, 1, 1, 1}));
  // Alone, nothing is hidden and no view is looked for; the counts are the same.
  EXPECT_EQ(countsOf(evaluateScene({floor, lamp}, receiver).sources.value()), Counts({1, 0, 0, 0, 0, 0, 1, 0}));
  EXPECT_EQ(countsOf(evaluateScene({screen}, receiver).sources.value()), Counts({0, 0, 0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(countsOf(evaluateScene({star}, receiver).sources.value()), Counts({0, 0, 0, 0, 0, 0, 0, 1}));
}

TEST(SceneEvaluator, SeesTheSheetThatItAllButTouchesAndNothingBehindIt) {
  for (const double shift : {0.0, 1.0, 1e3, 1e6}) {
    for (double height = 1e-16; height < 1e-6; height *= 2.0) {
      Polygon sheet = squareAt("sheet", 0.0, 0.5, 1.0);
      Polygon lamp = squareAt("lamp", 1.0, 0.5, 7.0);
      for (Polygon* polygon : {&sheet, &lamp}) {
        for (Vector3d& v : polygon->vertices) v(0) += shift;
      }
      const Receiver receiver{{shift + 0.125, -0.25, -height}, kUp};
      const SceneEvaluation<3> both = evaluateScene({sheet, lamp}, receiver);
      const SceneEvaluation<3> alone = evaluateScene({sheet}, receiver);
      if (alone.derivatives.irradiance.value == 0.0) continue;  // the receiver's own surface
      EXPECT_EQ(both.derivatives.irradiance.value, alone.derivatives.irradiance.value) << shift << ' ' << height;
      EXPECT_LE(both.derivatives.irradiance.value, std::numbers::pi + both.bounds.irradiance);
    }
  }
}

TEST(SceneEvaluator, RefusesPolygonsOfDifferentRadianceInOnePlace) {
  const Polygon lamp = squareAt("lamp", 2.0, 1.0, 5.0);
  const Receiver receiver{{0.1, 0.0, 0.0}, kUp};
  EXPECT_THAT(refusalOf({lamp, squareAt("inner", 2.0, 0.5, 1.0)}, receiver),
              AllOf(HasSubstr("polygons[0] \"lamp\""), HasSubstr("polygons[1] \"inner\""), HasSubstr("one plane")));
  // A duplicate changes nothing.
  const SceneEvaluation<3> twice = evaluateScene({lamp, lamp}, receiver);
  EXPECT_NEAR(twice.derivatives.irradiance.value, evaluateScene({lamp}, receiver).derivatives.irradiance.value,
              twice.bounds.irradiance);
  // Hidden, it does not matter.
  EXPECT_EQ(refusalOf({lamp, squareAt("inner", 2.0, 0.5, 1.0), squareAt("screen", 1.0, 3.0, 0.0)}, receiver), "");
}

TEST(SceneEvaluator, FollowsANonConvexOutline) {
  // An L with a square in its notch, and then one that reaches into it.
  const Polygon ell{"ell", {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}}, 1.0};
  Polygon notch{"notch", {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}}, 1.0};
  const Receiver receiver{{0.8, 0.9, 0.0}, kUp};
  EXPECT_FALSE(evaluateScene({ell, notch}, receiver).has_occlusion);
  notch.vertices[0] = Vector3d(0.9, 0.9, 1.0);
  EXPECT_TRUE(evaluateScene({ell, notch}, receiver).has_occlusion);
}

TEST(SceneEvaluator, TurnedFillingsOfANonConvexOutlineOnlyTouch) {
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
    EXPECT_EQ(refusalOf(moved(ell, motion), receiver), "") << i;
    EXPECT_EQ(refusalOf(moved(comb, motion), receiver), "") << i;
  }
}

TEST(SceneEvaluator, BlackPolygonsMayHideEachOther) {
  const std::vector<Polygon> scene = {squareAt("a", 1.0, 0.5, 0.0), squareAt("b", 2.0, 0.5, 0.0)};
  const SceneEvaluation<3> dark = evaluateScene(scene, {{0.0, 0.0, 0.0}, kUp});
  EXPECT_EQ(dark.derivatives.irradiance.value, 0.0);
  EXPECT_TRUE(dark.no_hessian.empty()) << dark.no_hessian;
}

TEST(SceneEvaluator, BlackScreenSeenEdgeOnLeavesNoDerivative) {
  // It hides nothing from here and half of the lamp from either side.
  const Polygon screen{"screen", {{0, -0.2, 0.5}, {0, 0.2, 0.5}, {0, 0.2, 1.0}, {0, -0.2, 1.0}}, 0.0};
  const auto sum = evaluateScene(std::vector{squareAt("lamp", 2.0, 1.0, 1.0), screen}, {{0.0, 0.0, 0.0}, kUp});
  EXPECT_GT(sum.derivatives.irradiance.value, 0.0);
  EXPECT_THAT(sum.no_gradient, AllOf(HasSubstr("polygons[1] \"screen\""), HasSubstr("edge-on")));
  EXPECT_FALSE(sum.no_tangential_hessian.empty());
}

TEST(SceneEvaluator, WhatIsBelowTheHorizonHidesNothing) {
  const std::vector<Polygon> scene = {squareAt("lamp", 2.0, 1.0, 5.0), squareAt("floor", -1.0, 0.5, 0.0),
                                      squareAt("deep", -2.0, 3.0, 1.0)};
  EXPECT_FALSE(evaluateScene(scene, {{0.0, 0.0, 0.0}, kUp}).has_occlusion);
}

TEST(SceneEvaluator, RadianceScalesAndSourcesAdd) {
  const Receiver receiver{{0.0, 0.0, 0.0}, kUp};
  const Polygon left = squareAt("left", 2.0, 0.5, 3.0, -1.0);
  const Polygon right = squareAt("right", 2.0, 0.5, 4.0, 1.0);
  const auto both = evaluateScene(std::vector{left, right}, receiver);
  const auto first = evaluateScene(std::vector{left}, receiver);
  const auto second = evaluateScene(std::vector{right}, receiver);
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
