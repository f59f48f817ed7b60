// Flatland estimators that know no occlusion, against small segments in the place of their patches.

#include "derivatives/flatland/strata_patches.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "tests/flatland/sampled_flatland.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

const FlatlandReceiver kOrigin{Vector2d(0.0, 0.0), Vector2d(0.0, 1.0)};

/// One sample that radiates.
FlatlandSamples only(FlatlandSamples samples, std::size_t lit) {
  for (std::size_t i = 0; i < samples.size(); ++i) samples.hits[i].radiance = i == lit ? 1.0 : 0.0;
  return samples;
}

/// Relative difference from a segment of the given middle and length.
double difference(const FlatlandEstimate& estimate, const Vector2d& middle, const Vector2d& along) {
  const Segment patch{"patch", {middle - 0.5 * along, middle + 0.5 * along}, 1.0};
  const IrradianceDerivatives<double, 2> d = evaluateSegment(patch, 0, kOrigin).derivatives;
  return (*estimate.gradient - d.gradient.value).norm() / d.gradient.value.norm() +
         (*estimate.hessian - d.hessian.value).norm() / d.hessian.value.norm();
}

TEST(FlatlandHemicubeTexel, IsASmallSegmentAtTheDepthOfEachHit) {
  constexpr std::size_t kCount = 400;
  const FlatlandStrata strata(FlatlandStratification::kSquare, kCount);
  const FlatlandSamples samples = sampleCentred(strata, [](const Vector2d& w) {
    return FlatlandHit{1.0 / (0.7 + w.y()), 1.0};
  });
  double worst = 0.0;
  double worst_at_face = 0.0;
  // The first and the last have an end on the horizon, where the second derivative along n is one-sided.
  for (std::size_t i = 1; i + 1 < kCount; ++i) {
    const Vector2d& w = samples.directions[i];
    const bool is_on_top = w.y() > std::abs(w.x());
    const Vector2d side = is_on_top ? Vector2d(0.0, 1.0) : Vector2d(std::copysign(1.0, w.x()), 0.0);
    const double depth = side.dot(w) / samples.hits[i].inverse_distance;
    const Vector2d along = 4.0 / kCount * depth * Vector2d(-side.y(), side.x());
    const FlatlandEstimate estimate = estimateHemicubeTexel(only(samples, i));
    worst = std::max(worst, difference(estimate, w / samples.hits[i].inverse_distance, along));
    // The article's texels are on the square itself.
    worst_at_face = std::max(worst_at_face, difference(estimate, w / side.dot(w), along / depth));
  }
  // A texel of 0.01 at a distance of 1 or more: second order, times up to (3 * 5 * 7)/24 of the fourth derivative.
  EXPECT_LE(worst, 5.0 * 0.01 * 0.01);
  EXPECT_GT(worst_at_face, 0.1);
}

TEST(FlatlandHemicubeTexel, ConvergesForLevelLampsOnly) {
  const FlatlandCase level{.stratification = FlatlandStratification::kSquare, .scene = levelLamp(), .tilt = 0.0};
  const FlatlandConvergence gradient =
      flatlandConvergence("hemicube-texel, level lamp, gradient", level, estimateHemicubeTexel, gradientDifference);
  const FlatlandConvergence hessian =
      flatlandConvergence("hemicube-texel, level lamp, Hessian", level, estimateHemicubeTexel, hessianDifference);
  EXPECT_TRUE(gradient.isReached()) << gradient;
  EXPECT_TRUE(hessian.isReached()) << hessian;
  FlatlandCase tilted = level;
  tilted.scene = tiltedLamp();
  const FlatlandConvergence slanted =
      flatlandConvergence("hemicube-texel, tilted lamp, Hessian", tilted, estimateHemicubeTexel, hessianDifference);
  EXPECT_FALSE(slanted.isReached()) << slanted;
  std::cout << gradient << hessian << slanted;
}

/// Along a straight line each patch is a piece of it, as long as its stratum takes.
TEST(FlatlandRadiometric, PatchesLieAlongTheSurface) {
  const std::vector<Segment> line{{"line", {Vector2d(-9.0, 0.4), Vector2d(9.0, 2.0)}, 1.0}};
  const Vector2d along = (line[0].vertices[1] - line[0].vertices[0]).normalized();
  const Vector2d across(-along.y(), along.x());
  constexpr std::size_t kCount = 400;
  const FlatlandStrata strata(FlatlandStratification::kCosine, kCount);
  const FlatlandSamples samples = sampleCentred(strata, rayCaster(line, kOrigin));
  double worst = 0.0;
  double worst_facing = 0.0;
  for (std::size_t i = kCount / 4; i < 3 * kCount / 4; ++i) {
    const Vector2d& w = samples.directions[i];
    const double r = 1.0 / samples.hits[i].inverse_distance;
    const double length = 2.0 / kCount * r / (w.y() * across.dot(w));
    const FlatlandEstimate estimate = estimateRadiometric(only(samples, i));
    worst = std::max(worst, difference(estimate, r * w, length * along));
    worst_facing =
        std::max(worst_facing, difference(estimate, r * w, length * across.dot(w) * Vector2d(-w.y(), w.x())));
  }
  EXPECT_LE(worst, 5.0 * 0.01 * 0.01);
  EXPECT_GT(worst_facing, 0.1);
}

TEST(FlatlandRadiometric, ConvergesWhereNothingIsHidden) {
  for (const FlatlandStratification stratification :
       {FlatlandStratification::kCosine, FlatlandStratification::kSquare}) {
    const FlatlandCase setting{.stratification = stratification, .scene = tiltedLamp()};
    const FlatlandConvergence gradient =
        flatlandConvergence("radiometric, tilted lamp, gradient", setting, estimateRadiometric, gradientDifference);
    const FlatlandConvergence hessian =
        flatlandConvergence("radiometric, tilted lamp, Hessian", setting, estimateRadiometric, hessianDifference);
    EXPECT_TRUE(gradient.isReached()) << gradient;
    EXPECT_TRUE(hessian.isReached()) << hessian;
    std::cout << gradient << hessian;
  }
  const FlatlandConvergence occluded =
      flatlandConvergence("radiometric, occluded, Hessian", {}, estimateRadiometric, hessianDifference);
  EXPECT_FALSE(occluded.isReached()) << occluded;
  std::cout << occluded;
}

/// A lone hit on the rim of an occluder takes the line of the hits beside it on the occluder, not that to the
/// background.
TEST(FlatlandRadiometric, AHitAtARimKeepsTheLineOfItsSurface) {
  const std::vector<Segment> scene{{"near", {Vector2d(-5.0, 1.0), Vector2d(0.0, 1.0)}, 1.0},
                                   {"far", {Vector2d(-5.0, 9.0), Vector2d(5.0, 9.0)}, 0.0}};
  const FlatlandSamples samples = sampleCentred({FlatlandStratification::kCosine, 100}, rayCaster(scene, kOrigin));
  ASSERT_EQ(samples.hits[49].radiance, 0.0);
  ASSERT_EQ(samples.hits[50].radiance, 1.0);
  const Vector2d& w = samples.directions[50];
  const double length = 2.0 / 100.0 / samples.hits[50].inverse_distance / (w.y() * w.y());
  EXPECT_LE(
      difference(estimateRadiometric(only(samples, 50)), w / samples.hits[50].inverse_distance, Vector2d(length, 0.0)),
      5.0 * 0.02 * 0.02);
}

TEST(FlatlandGeometric, IsTheSumOfAbsoluteCurvaturesAtTheMeanRadiance) {
  const std::vector<Segment> room = flatRoom(1.0);
  const FlatlandReceiver receiver{Vector2d(0.4, 0.1), Vector2d::UnitY()};
  FlatlandSamples samples = sampleJittered({FlatlandStratification::kCosine, 48}, 5, rayCaster(room, receiver));
  for (std::size_t i = 0; i < samples.size(); ++i) samples.hits[i].radiance = static_cast<double>(i % 5);
  const FlatlandEstimate geometric = estimateGeometric(samples);
  double absolute = 0.0;
  double plain = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double curvature = *estimateRadiometric(only(samples, i)).tangential_hessian;
    absolute += geometric.irradiance / 2.0 * std::abs(curvature);
    plain += geometric.irradiance / 2.0 * curvature;
  }
  EXPECT_NEAR(*geometric.tangential_hessian, absolute, 1e-13 * absolute);
  EXPECT_GT(std::abs(*geometric.tangential_hessian - plain), 0.1 * absolute);
  EXPECT_FALSE(geometric.gradient || geometric.hessian);
  // It bounds what any radiance up to the mean makes of the patches.
  for (const std::size_t period : {2u, 3u, 7u}) {
    FlatlandSamples other = samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      other.hits[i].radiance = i / 5 % period == 0 ? geometric.irradiance / 2.0 : 0.0;
    }
    EXPECT_LE(std::abs(*estimateRadiometric(other).tangential_hessian), *geometric.tangential_hessian);
  }
}

}  // namespace
}  // namespace irradiff
