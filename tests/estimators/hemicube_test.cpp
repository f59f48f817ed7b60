// Texel walls of a hemicube: the motion of texels, the printed rate of motion, and what the sum converges to.

#include "derivatives/estimators/hemicube.h"

#include "derivatives/estimators/texel_wall.h"
#include "tests/estimators/convergence.h"
#include "tests/estimators/sampled_scene.h"
#include "tests/estimators/wall_motion.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Strata hemicube(std::size_t resolution) { return {Stratification::kHemicube, {3 * resolution, resolution}}; }

/// Solid angle of the cone over a closed path of unit vectors, as a fan of triangles.
double solidAngle(const std::vector<Vector3d>& path) {
  double sum = 0.0;
  const Vector3d& apex = path.front();
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Vector3d& a = path[i];
    const Vector3d& b = path[i + 1];
    sum += 2.0 * std::atan2(apex.dot(a.cross(b)), 1.0 + apex.dot(a) + a.dot(b) + b.dot(apex));
  }
  return sum;
}

/// The derivative of a texel's solid angle when all its outline stays in place at distance 1.
Vector2d outlineMotion(const Strata& strata, std::size_t row, std::size_t column) {
  constexpr double kStep = 1e-4;
  std::vector<Vector3d> outline;
  for (std::size_t side = 0; side < kStratumSides; ++side) {
    const std::vector<Vector3d> points = sidePoints(strata, stratumSide(row, column, side), 200);
    outline.insert(outline.end(), points.begin(), points.end() - 1);
  }
  const auto seenFrom = [&outline](const Vector3d& x) {
    std::vector<Vector3d> seen;
    seen.reserve(outline.size());
    for (const Vector3d& w : outline) seen.push_back(seenAfter(w, x));
    return solidAngle(seen);
  };
  Vector2d rates;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    rates(axis) = (seenFrom(step) - seenFrom(-step)) / (2.0 * kStep);
  }
  return rates;
}

/// The printed pseudocode's gradient of a texel's solid angle, all walls at distance 1: each wall's unit normal in the
/// tangent plane times length times rate of motion, the rate being cos(theta) or 1 / sin(theta) at the wall's middle,
/// whichever kind of wall it is taken for.
//   d(theta)/dx = -cos(theta) / r,   d(phi)/dy = -1 / (r sin(theta))
// Castaño 2011, Translation Gradients.
Vector2d printedTexelGradient(const Strata& strata, std::size_t row, std::size_t column,
                              const std::function<bool(std::size_t side)>& has_constant_altitude) {
  Vector2d gradient = Vector2d::Zero();
  for (std::size_t side = 0; side < kStratumSides; ++side) {
    const StratumSide path = stratumSide(row, column, side);
    const TexelWall wall = texelWall(strata, path);
    const Vector3d middle = (strata.direction(path.start) + strata.direction(path.end)).normalized();
    const double rate = has_constant_altitude(side) ? middle.z() : 1.0 / middle.head<2>().norm();
    gradient -= wall.length * rate * wall.outer_normal.head<2>().normalized();
  }
  return gradient;
}

/// The estimator's gradient of a texel's solid angle: one texel of radiance 1 among dark ones.
Vector2d estimatedTexelGradient(const Strata& strata, std::size_t row, std::size_t column) {
  HemisphereSamples samples = uniformSamples(strata, 1.0, 0.0);
  const std::size_t texel = row * samples.shape.columns + column;
  samples.radiance[texel] = 1.0;
  const double cosine = samples.direction_n[texel];
  return makeHemicube(samples.stratification, samples.shape)->estimate(samples).gradient->head<2>() / cosine;
}

TEST(Hemicube, TexelsMoveAsTheirOutlinesDo) {
  for (const std::size_t resolution : {2u, 6u}) {
    const Strata strata = hemicube(resolution);
    for (std::size_t row = 0; row < 3 * resolution; ++row) {
      // At the horizon as well: that side moves along itself.
      for (std::size_t column = 0; column < resolution; ++column) {
        const Vector2d motion = outlineMotion(strata, row, column);
        // The differences are of second order in a step of 1e-4 and in 200 pieces.
        EXPECT_LE((estimatedTexelGradient(strata, row, column) - motion).norm(), 1e-4 * motion.norm() + 1e-6)
            << "row " << row << ", column " << column << " of resolution " << resolution;
      }
    }
  }
}

/// On half faces walls between columns do have constant azimuth. They sweep the sphere at the rate 1 / r: the printed
/// 1 / (r sin(theta)) is that of the azimuth, and the length that goes with it would be measured in cos(theta).
TEST(Hemicube, ThePrintedRateOfAWallOfConstantAzimuthIsThatOfItsAzimuth) {
  const Strata strata = hemicube(6);
  const std::size_t row = 6 + 2;
  for (const std::size_t column : {0u, 2u, 5u}) {
    const Vector2d motion = outlineMotion(strata, row, column);
    const Vector2d printed = printedTexelGradient(strata, row, column, [](std::size_t side) { return side % 2 == 1; });
    std::cout << "printed rate, column " << column << ": off by " << (printed - motion).norm() / motion.norm() << '\n';
    EXPECT_GT((printed - motion).norm(), 0.1 * motion.norm());
  }
}

/// What the sum tends to: the gradient without the change of the cosine of what stays in its texel,
///   grad E - integral of L (n.w) w / r dw   in the tangent plane.
/// The integral by fine centred strata of equal projected solid angle.
SceneDerivatives limitOfTexelWalls(const std::vector<Polygon>& scene, const SampleFrame& frame) {
  SceneDerivatives limit = trueDerivatives(scene, frame);
  const HemisphereSamples fine =
      sampleScene(scene, frame, {Stratification::kConcentric, {512, 512}}, SamplePlaces::centred());
  Vector3d lost = Vector3d::Zero();
  for (std::size_t i = 0; i < fine.shape.size(); ++i) {
    lost +=
        kPi / static_cast<double>(fine.shape.size()) * fine.radiance[i] * fine.inverse_distance[i] * fine.direction(i);
  }
  limit.gradient -= lost;
  return limit;
}

TEST(Hemicube, ConvergesToTheGradientWithoutTheChangeOfTheCosine) {
  for (const std::vector<Polygon>& scene : {occludedEmitter(), room(1.0)}) {
    const Convergence to_limit =
        convergence("hemicube", Stratification::kHemicube, scene, tangentialGradientError, limitOfTexelWalls);
    EXPECT_TRUE(to_limit.isReached()) << to_limit;
    std::cout << "to its limit, " << to_limit;
  }
}

TEST(Hemicube, DoesNotConvergeToTheGradient) {
  const Convergence to_truth =
      convergence("hemicube", Stratification::kHemicube, levelEmitter(), tangentialGradientError);
  EXPECT_FALSE(to_truth.isReached()) << to_truth;
  const Convergence by_projected_walls =
      convergence("ward-heckbert", Stratification::kHemicube, levelEmitter(), tangentialGradientError);
  EXPECT_TRUE(by_projected_walls.isReached()) << by_projected_walls;
  std::cout << "texel walls with the texel's cosine, " << to_truth << "walls in the projected solid angle, "
            << by_projected_walls;
}

TEST(Hemicube, RotationalGradientConverges) {
  const Convergence rotation =
      convergence("hemicube", Stratification::kHemicube, occludedEmitter(), rotationalGradientError);
  EXPECT_TRUE(rotation.isReached()) << rotation;
  // The article's (d_y, -d_x, 0) is d x n, for the pair n_2 x n: minus ours.
  const Convergence with_article_sign = convergence(
      [](const HemisphereSamples& samples) {
        IrradianceEstimate estimate = makeHemicube(samples.stratification, samples.shape)->estimate(samples);
        *estimate.rotational_gradient *= -1.0;
        return estimate;
      },
      Stratification::kHemicube, occludedEmitter(), rotationalGradientError);
  EXPECT_FALSE(with_article_sign.isReached());
}

}  // namespace
}  // namespace irradiff
