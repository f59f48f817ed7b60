// E, gradient and Hessian from exact visibility at several scalars, and the production path against their enclosures.

#include "verification/exact_boundary/exact_boundary.h"

#include "derivatives/visibility/scene_evaluation.h"
#include "tests/exact_visibility/random_scene.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/enclosure/ball_vector.h"
#include "verification/multiprecision/multiprecision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 11;
constexpr std::size_t kScenes = 700;
constexpr slong kBits = 200;

std::vector<double> radiancesOf(const std::vector<Polygon>& polygons) {
  std::vector<double> radiances;
  radiances.reserve(polygons.size());
  for (const Polygon& polygon : polygons) radiances.push_back(polygon.radiance);
  return radiances;
}

/// Triangles with any doubles as coordinates, stars and triangles on a small lattice, in turn.
RandomScene sceneAt(std::size_t index) {
  if (index % 3 == 1) return randomScene(kSeed, index, 4);
  if (index % 3 == 2) return latticeScene(kSeed, index, 5);
  KeyedRandom random(kSeed, "triangles", index);
  const auto point = [&random] {
    const double x = random.between(-1.0, 1.0);
    const double y = random.between(-1.0, 1.0);
    return Eigen::Vector3d(x, y, random.between(-1.0, 1.0));
  };
  RandomScene scene;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d a = point();
    const Eigen::Vector3d b = point();
    scene.polygons.push_back({"triangle", {a, b, point()}, random.between(0.0, 2.0)});
  }
  scene.receiver.position = point();
  scene.receiver.normal = random.direction();
  return scene;
}

ExactBoundary boundaryOf(const RandomScene& scene) {
  return exactBoundary(exactVisibility(scene.polygons, scene.receiver), scene.polygons, radiancesOf(scene.polygons),
                       scene.receiver);
}

/// The largest distance of an entry from its ball as a multiple of the bound, rounded upwards.
template <class Values, class Balls>
double distance(const Values& values, const Balls& balls, double bound) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const Ball excess = (Ball(values.data()[i]) - balls.data()[i]).magnitude();
    // What the production path knows exactly has no error to divide.
    if (bound > 0.0) {
      largest = std::max(largest, (excess / Ball(bound)).magnitude().toDouble());
    } else if (!excess.containsZero()) {
      largest = std::numeric_limits<double>::infinity();
    }
  }
  return largest;
}

/// Whether the terms of apparent vertices have not cancelled out, exactly.
bool movesTheHessian(const ExactBoundary& exact) {
  const RationalMatrix& m = exact.vertex_hessian;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (m[i][j] + m[j][i] != 0) return true;
    }
  }
  return false;
}

struct Agreement {
  double irradiance = 0.0;
  double gradient = 0.0;
  double hessian = 0.0;
};

/// How far the production path is from the enclosures, in multiples of its error bounds.
Agreement agreement(const SceneEvaluation<3>& evaluation, const IrradianceDerivatives<Ball>& balls) {
  using Single = Eigen::Matrix<double, 1, 1>;
  using SingleBall = Eigen::Matrix<Ball, 1, 1>;
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  Agreement result;
  const Single irradiance = Single::Constant(d.irradiance.value);
  const SingleBall irradiance_ball = SingleBall::Constant(balls.irradiance.value);
  result.irradiance = distance(irradiance, irradiance_ball, evaluation.bounds.irradiance);
  if (evaluation.no_gradient.empty()) {
    result.gradient = distance(d.gradient.value, balls.gradient.value, evaluation.bounds.gradient);
  }
  if (evaluation.no_hessian.empty()) {
    result.hessian = distance(d.hessian.value, balls.hessian.value, evaluation.bounds.hessian);
  }
  return result;
}

TEST(ExactBoundary, TheProductionPathIsWithinItsBoundsOfTheEnclosures) {
  const WorkingPrecision precision(kBits);
  Agreement largest;
  std::size_t scenes = 0;
  std::size_t hessians = 0;
  std::size_t with_vertices = 0;
  std::size_t wrong_without_vertices = 0;
  std::size_t wrong_with_vertices_reversed = 0;
  for (std::size_t index = 0; index < lengthened(kScenes); ++index) {
    const RandomScene scene = sceneAt(index);
    const SceneEvaluator evaluator(scene.polygons);
    SceneEvaluation<3> evaluation;
    try {
      evaluation = evaluator.evaluate(scene.receiver);
    } catch (const InvalidScene&) {
      continue;  // the receiver is on a polygon
    }
    const ExactBoundary exact = boundaryOf(scene);
    const BallVector normal = exactly(scene.receiver.normal);
    const Agreement found = agreement(evaluation, sumsOf<Ball>(exact, normal).derivatives);
    ++scenes;
    hessians += evaluation.no_hessian.empty() ? 1U : 0U;
    EXPECT_LE(found.irradiance, 1.0) << "scene " << index;
    EXPECT_LE(found.gradient, 1.0) << "scene " << index;
    EXPECT_LE(found.hessian, 1.0) << "scene " << index;
    largest.irradiance = std::max(largest.irradiance, found.irradiance);
    largest.gradient = std::max(largest.gradient, found.gradient);
    largest.hessian = std::max(largest.hessian, found.hessian);
    // The exact route may know of no derivative where the production path has one; not the reverse.
    if (evaluation.no_hessian.empty() && exact.no_hessian.empty() && movesTheHessian(exact)) {
      ++with_vertices;
      ExactBoundary spoilt = exact;
      for (RationalVector& row : spoilt.vertex_hessian) row = Rational(-1) * row;
      wrong_with_vertices_reversed +=
          agreement(evaluation, sumsOf<Ball>(spoilt, normal).derivatives).hessian > 1.0 ? 1U : 0U;
      spoilt.vertex_hessian = {};
      wrong_without_vertices += agreement(evaluation, sumsOf<Ball>(spoilt, normal).derivatives).hessian > 1.0 ? 1U : 0U;
    }
  }
  std::cout << scenes << " scenes, " << hessians << " with a Hessian, " << with_vertices
            << " of them with apparent vertices; at most " << largest.irradiance << ", " << largest.gradient << ", "
            << largest.hessian << " of the bounds of E, gradient and Hessian\n";
  EXPECT_GE(scenes, std::min<std::size_t>(500, lengthened(kScenes) * 5 / 7));
  // The bad twins.
  EXPECT_GT(with_vertices, scenes / 4);
  EXPECT_EQ(wrong_without_vertices, with_vertices);
  EXPECT_EQ(wrong_with_vertices_reversed, with_vertices);
}

TEST(ExactBoundary, RejectsASideSwappedInEveryScene) {
  const WorkingPrecision precision(kBits);
  std::size_t spoilt_scenes = 0;
  for (std::size_t index = 0; index < 30; index += 3) {
    const RandomScene scene = sceneAt(index);
    ExactBoundary exact = boundaryOf(scene);
    if (exact.arcs.empty()) continue;
    exact.arcs.front().radiance_jump *= -1.0;
    const Agreement found = agreement(SceneEvaluator(scene.polygons).evaluate(scene.receiver),
                                      sumsOf<Ball>(exact, exactly(scene.receiver.normal)).derivatives);
    EXPECT_GT(found.gradient, 1.0) << "scene " << index;
    ++spoilt_scenes;
  }
  EXPECT_GE(spoilt_scenes, 5U);
}

TEST(ExactBoundary, AllScalarsAgree) {
  const WorkingPrecision precision(kBits);
  std::size_t compared = 0;
  for (std::size_t index = 0; index < 60; ++index) {
    const RandomScene scene = sceneAt(index);
    const ExactBoundary exact = boundaryOf(scene);
    if (!exact.no_hessian.empty() || exact.arcs.empty()) continue;
    const IrradianceDerivatives<Ball> balls = sumsOf<Ball>(exact, exactly(scene.receiver.normal)).derivatives;
    const BoundarySums<double> doubles = sumsOf<double>(exact, scene.receiver.normal);
    const IrradianceDerivatives<Multiprecision> digits =
        sumsOf<Multiprecision>(exact, withoutRounding(scene.receiver.normal)).derivatives;
    // The roundings of docs/derivations/error_bounds.md, sections 2.4 to 2.7, and those of adding the vertices.
    const double terms = static_cast<double>(exact.arcs.size() + exact.horizon.size() + 4);
    const double vertex_size = [&exact] {
      double largest = 0.0;
      for (const RationalVector& row : exact.vertex_hessian) {
        for (const Rational& entry : row) largest = std::max(largest, std::abs(entry.convert_to<double>()));
      }
      return largest;
    }();
    const double unit = 0x1p-53;
    const auto isNear = [](double value, const Ball& ball, double bound) {
      return (Ball(value) - ball).magnitude() <= Ball(bound);
    };
    const auto isInside = [](const Multiprecision& value, const Ball& ball) {
      // 200 digits are more than a ball of 200 bits tells apart: only its own error is left.
      return Ball::fromDecimal(value.str(190)).overlaps(ball + Ball::aroundZero(Ball::powerOfTwo(-180)));
    };
    EXPECT_TRUE(isNear(doubles.derivatives.irradiance.value, balls.irradiance.value,
                       (kAngleError + terms) * unit * doubles.irradiance_size))
        << index;
    EXPECT_TRUE(isInside(digits.irradiance.value, balls.irradiance.value)) << index;
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(isNear(doubles.derivatives.gradient.value(i), balls.gradient.value(i),
                         (kArcError + terms) * unit * doubles.gradient_size))
          << index;
      EXPECT_TRUE(isInside(digits.gradient.value(i), balls.gradient.value(i))) << index;
      for (int j = 0; j < 3; ++j) {
        EXPECT_TRUE(isNear(doubles.derivatives.hessian.value(i, j), balls.hessian.value(i, j),
                           (kArcError + terms) * unit * (doubles.hessian_size + vertex_size)))
            << index;
        EXPECT_TRUE(isInside(digits.hessian.value(i, j), balls.hessian.value(i, j))) << index;
      }
    }
    ++compared;
  }
  EXPECT_GE(compared, 20U);
}

}  // namespace
}  // namespace irradiff
