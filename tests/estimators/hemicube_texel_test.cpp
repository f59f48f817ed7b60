// Patches parallel to the faces of a hemicube: the article's formula, level and upright emitters, and where it fails.

#include "derivatives/estimators/hemicube_texel.h"

#include "tests/estimators/convergence.h"
#include "tests/estimators/sampled_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Strata hemicube(std::size_t resolution) { return {Stratification::kHemicube, {3 * resolution, resolution}}; }

/// Hits on the hemicube itself, as the article has them: at 1/r = cos(theta) on the top face.
TEST(HemicubeTexel, IsTheArticlesSumOnTheTopFace) {
  const std::size_t resolution = 4;
  HemisphereSamples samples = uniformSamples(hemicube(resolution), 1.0, 0.0);
  const double texel_area = std::pow(2.0 / static_cast<double>(resolution), 2);
  // The receiver at (s, t, 0) sees the texel centre (x, y, 1) at cos^-2 = 1 + (x-s)^2 + (y-t)^2.
  Vector2d expected = Vector2d::Zero();
  double total = 0.0;
  for (std::size_t i = 0; i < resolution * resolution; ++i) {
    const Vector3d w = samples.direction(i);
    samples.inverse_distance[i] = w.z();
    samples.radiance[i] = 0.5 + static_cast<double>(i * i % 7);
    const Vector2d centre = w.head<2>() / w.z();
    // grad cos^4 = 4 cos^6 (x-s, y-t) at s = t = 0.
    const Vector2d term = 4.0 * samples.radiance[i] * texel_area * std::pow(w.z(), 6) * centre;
    expected += term;
    total += term.norm();
  }
  const IrradianceEstimate estimate = makeHemicubeTexel(samples.stratification, samples.shape)->estimate(samples);
  EXPECT_LE((estimate.gradient->head<2>() - expected).norm(), 30.0 * 0x1p-53 * total);
}

/// One texel's patch, on every face, against central differences of what it adds to a receiver that moves.
double disagreementWithDifferences(std::size_t texel, double share_of_hessian) {
  const Strata strata = hemicube(4);
  HemisphereSamples samples = uniformSamples(strata, 1.0, 0.0);
  samples.radiance[texel] = 2.0;
  samples.inverse_distance[texel] = 0.8;
  const Vector3d hit = samples.direction(texel) / 0.8;
  const Vector3d faces[] = {Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY(), -Vector3d::UnitX(),
                            -Vector3d::UnitY()};
  const std::size_t row = texel / 4;
  const Vector3d face = faces[row < 4 ? 0 : 1 + (row - 4) / 2];
  // The texel has side 1/2 on the hemicube at distance 1.
  const double area = 0.25 * std::pow(face.dot(hit), 2);
  const auto f = [&](const Vector3d& x) {
    const Vector3d p = hit - x;
    return 2.0 * area * p.z() * face.dot(p) / std::pow(p.squaredNorm(), 2);
  };
  constexpr double kStep = 1e-3;
  const auto unit = [&](int i) { return Vector3d(kStep * Vector3d::Unit(i)); };
  Vector3d gradient;
  Eigen::Matrix3d hessian;
  for (int i = 0; i < 3; ++i) {
    gradient(i) = (f(unit(i)) - f(-unit(i))) / (2.0 * kStep);
    for (int j = 0; j < 3; ++j) {
      hessian(i, j) = (f(unit(i) + unit(j)) - f(unit(i) - unit(j)) - f(unit(j) - unit(i)) + f(-unit(i) - unit(j))) /
                      (4.0 * kStep * kStep);
    }
  }
  const IrradianceEstimate estimate = makeHemicubeTexel(samples.stratification, samples.shape)->estimate(samples);
  return std::max((*estimate.gradient - gradient).norm() / gradient.norm(),
                  (share_of_hessian * *estimate.hessian - hessian).norm() / hessian.norm());
}

TEST(HemicubeTexel, DerivativesAgreeWithDifferences) {
  for (std::size_t texel = 0; texel < 48; ++texel) {
    // Second order in a step of a thousandth of the distance, times fourth derivatives: below 100 times the second.
    EXPECT_LE(disagreementWithDifferences(texel, 1.0), 1e-4) << texel;
    EXPECT_GT(disagreementWithDifferences(texel, 1.001), 1e-4) << texel;
    EXPECT_GT(disagreementWithDifferences(texel, -1.0), 1e-4) << texel;
  }
}

/// A square facing the receivers' plane from the side, so far that it is seen through one half face.
std::vector<Polygon> uprightEmitter(double quarter_turns) {
  const Eigen::AngleAxisd turn(quarter_turns * std::numbers::pi / 2.0, Vector3d::UnitZ());
  return {parallelogram("upright", turn * Vector3d(3.0, 0.1, 1.0), turn * Vector3d(0.0, 0.6, 0.0),
                        turn * Vector3d(0.0, 0.1, 0.5), 2.0)};
}

TEST(HemicubeTexel, ConvergesForEmittersParallelToAFace) {
  for (const auto& error : {gradientError, hessianError}) {
    const Convergence level = convergence("hemicube-texel", Stratification::kHemicube, levelEmitter(), error);
    EXPECT_TRUE(level.isReached()) << level;
    std::cout << "level, " << level;
    for (const double quarter_turns : {0.0, 1.0, 2.0, 3.0}) {
      const Convergence upright =
          convergence("hemicube-texel", Stratification::kHemicube, uprightEmitter(quarter_turns), error);
      EXPECT_TRUE(upright.isReached()) << upright;
    }
  }
}

TEST(HemicubeTexel, FailsForTiltedEmittersAndUnderOccluders) {
  for (const std::vector<Polygon>& scene : {tiltedEmitter(), occludedEmitter()}) {
    for (const auto& error : {gradientError, hessianError}) {
      const Convergence failing = convergence("hemicube-texel", Stratification::kHemicube, scene, error);
      EXPECT_FALSE(failing.isReached()) << failing;
      EXPECT_GT(failing.errors.back(), 0.1) << failing;
    }
  }
}

/// The flaw of a patch at depth 1, whatever the depth of the hit: the unit of length shows in the gradient.
TEST(HemicubeTexel, DepthCounts) {
  const Strata strata = hemicube(8);
  HemisphereSamples samples = uniformSamples(strata, 1.0, 0.0);
  samples.radiance[10] = 1.0;
  const auto estimator = makeHemicubeTexel(samples.stratification, samples.shape);
  const IrradianceEstimate near = estimator->estimate(samples);
  samples.inverse_distance[10] = 0.25;
  const IrradianceEstimate far = estimator->estimate(samples);
  EXPECT_EQ(*far.gradient, 0.25 * *near.gradient);
  EXPECT_EQ(*far.hessian, 0.0625 * *near.hessian);
}

}  // namespace
}  // namespace irradiff
