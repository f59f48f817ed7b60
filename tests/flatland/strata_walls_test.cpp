// The gradients from walls between flatland strata.

#include "derivatives/flatland/strata_walls.h"

#include "derivatives/flatland/flatland_estimator.h"
#include "tests/flatland/sampled_flatland.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;

enum class Mistake {
  kNone,
  kFartherHit,    ///< walls move with the farther of the hits beside them
  kHarmonicMean,  ///< with the harmonic mean of both distances
};

double wallDistance(const FlatlandHit& a, const FlatlandHit& b, Mistake mistake) {
  const double r_a = 1.0 / a.inverse_distance;
  const double r_b = 1.0 / b.inverse_distance;
  if (mistake == Mistake::kFartherHit) return std::max(r_a, r_b);
  if (mistake == Mistake::kHarmonicMean) return 2.0 / (1.0 / r_a + 1.0 / r_b);
  return std::min(r_a, r_b);
}

/// E of windows whose walls are points of the scene, seen from `moved` along the tangent: the integral of n.w between
/// the directions of two points is the difference of the directions' tangential components.
double irradianceOfWindows(const FlatlandSamples& samples, double moved, Mistake mistake) {
  const std::vector<Vector2d> borders = samples.strata.borders();
  double irradiance = 0.0;
  double previous = 1.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double next = -1.0;
    if (i + 1 < samples.size()) {
      const Vector2d wall = wallDistance(samples.hits[i], samples.hits[i + 1], mistake) * borders[i + 1];
      next = (wall.x() - moved) / std::hypot(wall.x() - moved, wall.y());
    }
    irradiance += samples.hits[i].radiance * (previous - next);
    previous = next;
  }
  return irradiance;
}

double motionOfWindows(const FlatlandSamples& samples, Mistake mistake) {
  const double step = 1e-5;
  return (irradianceOfWindows(samples, step, mistake) - irradianceOfWindows(samples, -step, mistake)) / (2.0 * step);
}

FlatlandSamples randomSamples(FlatlandStratification stratification, std::size_t count) {
  KeyedRandom random(4, "walls", count);
  return sampleCentred({stratification, count}, [&random](const Vector2d&) {
    return FlatlandHit{1.0 / random.between(0.5, 3.0), random.between(0.0, 2.0)};
  });
}

TEST(FlatlandWardHeckbert, IsTheMotionOfWindowsAtTheNearerDistance) {
  for (const auto& [stratification, count] : {std::pair{FlatlandStratification::kCosine, 1u},
                                              {FlatlandStratification::kCosine, 2u},
                                              {FlatlandStratification::kCosine, 33u},
                                              {FlatlandStratification::kSquare, 4u},
                                              {FlatlandStratification::kSquare, 64u}}) {
    const FlatlandSamples samples = randomSamples(stratification, count);
    const FlatlandEstimate estimate = estimateWardHeckbert(samples);
    // Terms of at most 4; central differences of step 1e-5 with third derivatives up to 100 and 1e-16/1e-5 of rounding.
    const double bound = static_cast<double>(count) * 1e-8;
    EXPECT_NEAR(estimate.gradient->x(), motionOfWindows(samples, Mistake::kNone), bound);
    EXPECT_EQ(estimate.gradient->y(), 0.0);
    EXPECT_FALSE(estimate.knows_normal_component);
    EXPECT_FALSE(estimate.hessian || estimate.tangential_hessian);
    if (count == 1) continue;
    for (const Mistake mistake : {Mistake::kFartherHit, Mistake::kHarmonicMean}) {
      EXPECT_GT(std::abs(estimate.gradient->x() - motionOfWindows(samples, mistake)), 100.0 * bound);
    }
    EXPECT_GT(std::abs(-estimate.gradient->x() - motionOfWindows(samples, Mistake::kNone)), 100.0 * bound);
  }
}

TEST(FlatlandWardHeckbert, ConvergesUnderOccluders) {
  for (const FlatlandStratification stratification :
       {FlatlandStratification::kCosine, FlatlandStratification::kSquare}) {
    const FlatlandCase setting{.stratification = stratification};
    const FlatlandConvergence gradient = flatlandConvergence("ward-heckbert, tangential gradient", setting,
                                                             estimateWardHeckbert, tangentialGradientDifference);
    EXPECT_TRUE(gradient.isReached()) << gradient;
    std::cout << gradient;
  }
}

TEST(FlatlandWardHeckbert, AWrongDistanceDoesNotConverge) {
  for (const Mistake mistake : {Mistake::kFartherHit, Mistake::kHarmonicMean}) {
    const FlatlandConvergence gradient = flatlandConvergence(
        "wrong distance", {},
        [mistake](const FlatlandSamples& samples) {
          FlatlandEstimate estimate;
          estimate.gradient = Vector2d(motionOfWindows(samples, mistake), 0.0);
          return estimate;
        },
        tangentialGradientDifference);
    EXPECT_FALSE(gradient.isReached()) << gradient;
  }
}

/// grad E less the integral of L (n.w)(w.t)/r, along the tangent, by the midpoint rule over 65,536 angles.
FlatlandEstimate limitOfHemicube(std::span<const Segment> scene, const FlatlandReceiver& receiver) {
  constexpr std::size_t kAngles = 1 << 16;
  const FlatlandRayQuery cast = rayCaster(scene, receiver);
  FlatlandEstimate limit = trueEstimate(scene, receiver);
  for (std::size_t i = 0; i < kAngles; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / kAngles;
    const Vector2d w(std::cos(angle), std::sin(angle));
    const FlatlandHit hit = cast(w);
    limit.gradient->x() -= std::numbers::pi / kAngles * hit.radiance * w.y() * w.x() * hit.inverse_distance;
  }
  return limit;
}

TEST(FlatlandHemicube, ConvergesToTheGradientLessTheChangeOfTheCosine) {
  const FlatlandCase setting{.stratification = FlatlandStratification::kSquare};
  const FlatlandConvergence limit = flatlandConvergence("hemicube, against its limit", setting, estimateHemicube,
                                                        tangentialGradientDifference, limitOfHemicube);
  EXPECT_TRUE(limit.isReached()) << limit;
  const FlatlandConvergence gradient =
      flatlandConvergence("hemicube, against the gradient", setting, estimateHemicube, tangentialGradientDifference);
  EXPECT_FALSE(gradient.isReached()) << gradient;
  std::cout << limit << gradient;
}

}  // namespace
}  // namespace irradiff
