// The gradient from strata walls: the published sum, the mistakes that renderers made in it, and exact scenes.

#include "derivatives/estimators/ward_heckbert.h"

#include "derivatives/estimators/estimator.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "tests/estimators/convergence.h"
#include "tests/estimators/sampled_scene.h"
#include "tests/estimators/wall_motion.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

enum class Mistake {
  kNone,
  kSkipsInnermostRing,   ///< the loop over rings starts at 2 where the second ring is number 1
  kDegrees,              ///< azimuths in degrees taken for radians
  kFartherHit,           ///< the wall moves with the farther of the hits beside it
  kHarmonicMean,         ///< with the harmonic mean of both distances
  kOpenRing,             ///< no wall between the last column and the first
  kStartOfColumn,        ///< u_k at the start of the column, not at its middle
  kCosineOnce,           ///< cos theta in place of cos^2 theta
  kZeroDistance,         ///< hits that are nearer than a micrometre are at distance 0, as rounded positions have it
  kSpokeByMiddleCosine,  ///< cos(theta_j) (cos theta_- - cos theta_+) / sin(theta_j), as later texts have the spokes
};

/// The published sum over rings and columns, with a mistake.
//   sum_k { u_k 2 pi/N sum_{j>=1} sin(theta_j-) cos^2(theta_j-) / min(r_jk, r_j-1,k) (L_jk - L_j-1,k)
//         + v_k- sum_j (sin(theta_j+) - sin(theta_j-)) / min(r_jk, r_j,k-1) (L_jk - L_j,k-1) }
// Ward and Heckbert 1992.
Vector2d publishedGradient(const HemisphereSamples& samples, Mistake mistake) {
  const std::size_t rings = samples.shape.rows;
  const std::size_t columns = samples.shape.columns;
  const double turn = mistake == Mistake::kDegrees ? 360.0 : 2.0 * kPi;
  const auto sine = [rings](double ring) { return std::sqrt(ring / static_cast<double>(rings)); };
  const auto cosine = [rings](double ring) { return std::sqrt(1.0 - ring / static_cast<double>(rings)); };
  const auto overDistance = [&](std::size_t a, std::size_t b) {
    const auto distance = [&](std::size_t sample) {
      const double r = 1.0 / samples.inverse_distance[sample];
      return mistake == Mistake::kZeroDistance && r < 1e-6 ? 0.0 : r;
    };
    const double r_a = distance(a);
    const double r_b = distance(b);
    if (mistake == Mistake::kFartherHit) return 1.0 / std::max(r_a, r_b);
    if (mistake == Mistake::kHarmonicMean) return (1.0 / r_a + 1.0 / r_b) / 2.0;
    return 1.0 / std::min(r_a, r_b);
  };
  Vector2d gradient = Vector2d::Zero();
  for (std::size_t k = 0; k < columns; ++k) {
    const double middle = turn * (static_cast<double>(k) + (mistake == Mistake::kStartOfColumn ? 0.0 : 0.5)) /
                          static_cast<double>(columns);
    const double start = turn * static_cast<double>(k) / static_cast<double>(columns);
    const Vector2d u(std::cos(middle), std::sin(middle));
    const Vector2d v(-std::sin(start), std::cos(start));
    for (std::size_t j = 0; j < rings; ++j) {
      const std::size_t here = j * columns + k;
      const auto inner = static_cast<double>(j);
      if (j > (mistake == Mistake::kSkipsInnermostRing ? 1u : 0u)) {
        const std::size_t below = here - columns;
        const double cosines = mistake == Mistake::kCosineOnce ? cosine(inner) : cosine(inner) * cosine(inner);
        gradient += 2.0 * kPi / static_cast<double>(columns) * sine(inner) * cosines * overDistance(here, below) *
                    (samples.radiance[here] - samples.radiance[below]) * u;
      }
      if (k == 0 && mistake == Mistake::kOpenRing) continue;
      const std::size_t before = k == 0 ? here + columns - 1 : here - 1;
      const double length = mistake == Mistake::kSpokeByMiddleCosine
                                ? cosine(inner + 0.5) * (cosine(inner) - cosine(inner + 1.0)) / sine(inner + 0.5)
                                : sine(inner + 1.0) - sine(inner);
      gradient += length * overDistance(here, before) * (samples.radiance[here] - samples.radiance[before]) * v;
    }
  }
  return gradient;
}

/// The derivative of the irradiance of strata whose walls move as their points do, each at the distance of the nearer
/// hit: what every form of the sum is meant to be.
Vector2d motionOfStrata(const HemisphereSamples& samples) {
  const Strata strata(samples.stratification, samples.shape);
  const double left_is_inside = samples.stratification == Stratification::kPolar ? -1.0 : 1.0;
  Vector2d gradient = Vector2d::Zero();
  forEachSharedSide(
      strata, [&](std::size_t first, std::size_t second, std::size_t row, std::size_t column, std::size_t side) {
        const Vector2d swept =
            left_is_inside * sweptProjectedSolidAngle(sidePoints(strata, stratumSide(row, column, side), 20));
        const double nearer = std::min(1.0 / samples.inverse_distance[first], 1.0 / samples.inverse_distance[second]);
        gradient += (samples.radiance[second] - samples.radiance[first]) / nearer * swept;
      });
  return gradient;
}

/// Every number different, so that no mistake cancels.
HemisphereSamples randomSamples(const Strata& strata) {
  HemisphereSamples samples = uniformSamples(strata, 1.0, 1.0);
  std::mt19937_64 random(4);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (std::size_t i = 0; i < samples.shape.size(); ++i) {
    samples.inverse_distance[i] = 1.0 / (0.5 + 3.0 * uniform());
    // Large jumps where columns start and around the first row, so that no wall's share averages out.
    const bool is_first_row = i < samples.shape.columns;
    samples.radiance[i] = uniform() + (samples.direction_b[i] > 0.0 ? 2.0 : 0.0) +
                          (is_first_row && samples.direction_t[i] > 0.0 ? 4.0 : 0.0);
  }
  return samples;
}

Vector2d tangential(const IrradianceEstimate& estimate) { return estimate.gradient->head<2>(); }

TEST(WardHeckbert, PolarIsThePublishedSum) {
  for (const GridShape shape : {GridShape{4, 64}, {7, 5}, {1, 3}, {3, 2}, {5, 1}, {1, 1}}) {
    const HemisphereSamples samples = randomSamples({Stratification::kPolar, shape});
    const Vector2d published = publishedGradient(samples, Mistake::kNone);
    const Vector2d estimated = tangential(makeWardHeckbert(Stratification::kPolar, shape)->estimate(samples));
    // Two walls a stratum, terms of about 1, 20 roundings each.
    const double bound = 2.0 * static_cast<double>(shape.size()) * 20.0 * 0x1p-53 * 6.0;
    EXPECT_LE((estimated - published).norm(), bound) << shape.rows << " x " << shape.columns;
  }
}

TEST(WardHeckbert, MistakesOfRenderersDisagreeWithTheMotionOfTheStrata) {
  // 64 columns: the published direction of a ring's wall is right to (pi/64)^2/6 = 4e-4.
  const HemisphereSamples samples = randomSamples({Stratification::kPolar, {4, 64}});
  const Vector2d motion = motionOfStrata(samples);
  const auto disagreement = [&](const Vector2d& gradient) { return (gradient - motion).norm() / motion.norm(); };
  constexpr double kAllowed = 1e-3;
  EXPECT_LE(disagreement(tangential(makeWardHeckbert(samples.stratification, samples.shape)->estimate(samples))),
            kAllowed);
  EXPECT_LE(disagreement(publishedGradient(samples, Mistake::kNone)), kAllowed);
  for (const auto& [name, mistake] : {std::pair{"skips the innermost ring", Mistake::kSkipsInnermostRing},
                                      {"degrees for radians", Mistake::kDegrees},
                                      {"farther hit", Mistake::kFartherHit},
                                      {"harmonic mean of the distances", Mistake::kHarmonicMean},
                                      {"open ring", Mistake::kOpenRing},
                                      {"direction at the start of the column", Mistake::kStartOfColumn},
                                      {"one cosine", Mistake::kCosineOnce},
                                      {"spokes by the middle cosine", Mistake::kSpokeByMiddleCosine}}) {
    const double off = disagreement(publishedGradient(samples, mistake));
    std::cout << name << ": off by " << off << '\n';
    EXPECT_GT(off, 10.0 * kAllowed) << name;
  }
  EXPECT_GT(disagreement(-motion), 10.0 * kAllowed);
}

/// One pair of hits that coincide with the receiver and with each other: no jump between them, no contribution.
TEST(WardHeckbert, ACoincidentPairOfEqualRadianceAddsNothingOfItsOwn) {
  HemisphereSamples samples = randomSamples({Stratification::kPolar, {4, 64}});
  samples.inverse_distance[70] = 1e9;
  samples.inverse_distance[71] = 1e9;
  samples.radiance[71] = samples.radiance[70];
  const Vector2d estimated = tangential(makeWardHeckbert(samples.stratification, samples.shape)->estimate(samples));
  const Vector2d published = publishedGradient(samples, Mistake::kNone);
  EXPECT_LE((estimated - published).norm(), 1e-12 * published.norm());
  EXPECT_TRUE(std::isnan(publishedGradient(samples, Mistake::kZeroDistance).norm()));
}

TEST(WardHeckbert, ConcentricAndHemicubeWallsMoveAsTheStrataDo) {
  for (const Strata& strata : {Strata(Stratification::kConcentric, {8, 8}), Strata(Stratification::kConcentric, {5, 9}),
                               Strata(Stratification::kHemicube, {12, 4})}) {
    const HemisphereSamples samples = randomSamples(strata);
    const Vector2d motion = motionOfStrata(samples);
    const Vector2d estimated = tangential(makeWardHeckbert(samples.stratification, samples.shape)->estimate(samples));
    // 20 pieces a wall of at most 1/2: second order.
    EXPECT_LE((estimated - motion).norm(), 1e-3 * motion.norm());
  }
}

TEST(WardHeckbert, ConstantRadianceGivesExactlyZero) {
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 16);
    HemisphereSamples samples = randomSamples(strata);
    samples.radiance.assign(samples.shape.size(), 3.25);
    const IrradianceEstimate estimate = makeWardHeckbert(stratification, samples.shape)->estimate(samples);
    EXPECT_EQ(*estimate.gradient, Vector3d::Zero());
    EXPECT_NEAR(estimate.irradiance, 3.25 * kPi, 1e-12);
  }
}

TEST(WardHeckbert, ConvergesUnderOccluders) {
  for (const Stratification stratification : kAllStratifications) {
    const Convergence gradient =
        convergence("ward-heckbert", stratification, occludedEmitter(), tangentialGradientError);
    EXPECT_TRUE(gradient.isReached()) << gradient;
    const Convergence rotation =
        convergence("ward-heckbert", stratification, occludedEmitter(), rotationalGradientError);
    EXPECT_TRUE(rotation.isReached()) << rotation;
    std::cout << "gradient " << gradient << "rotational " << rotation;
  }
}

TEST(WardHeckbert, AWrongDistanceDoesNotConverge) {
  for (const Mistake mistake : {Mistake::kFartherHit, Mistake::kHarmonicMean}) {
    const Convergence gradient = convergence(
        [mistake](const HemisphereSamples& samples) {
          IrradianceEstimate estimate;
          const Vector2d published = publishedGradient(samples, mistake);
          estimate.gradient = Vector3d(published.x(), published.y(), 0.0);
          return estimate;
        },
        Stratification::kPolar, closedScene(occludedEmitter()), tangentialGradientError);
    EXPECT_FALSE(gradient.isReached()) << gradient;
  }
}

/// E at a tilted normal is E + g.(n x n_2): the sign that belongs to -tan(theta) goes with n_2 x n.
TEST(WardHeckbert, RotationalGradientBelongsToNCrossTiltedNormal) {
  const std::vector<Polygon> scene = occludedEmitter();
  const SampleFrame frame = frameAt({0.1, -0.2, 0.0});
  // The turn that changes E most.
  const Vector3d axis = trueDerivatives(scene, frame).rotational_gradient.normalized();
  const Vector3d tilted = (Vector3d::UnitZ() + 0.02 * axis.cross(Vector3d::UnitZ())).normalized();
  const double change = SceneEvaluator(scene).evaluate({frame.position, tilted}).derivatives.irradiance.value -
                        trueDerivatives(scene, frame).irradiance;
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 64);
    const IrradianceEstimate estimate = makeWardHeckbert(stratification, strata.shape())
                                            ->estimate(sampleScene(scene, frame, strata, SamplePlaces::centred()));
    const double predicted = estimate.rotational_gradient->dot(Vector3d::UnitZ().cross(tilted));
    // Second order in the tilt, and a boundary that is off by up to a stratum in 32 across.
    EXPECT_NEAR(predicted, change, 0.1 * std::abs(change));
    EXPECT_GT(std::abs(-predicted - change), 0.1 * std::abs(change));
  }
}

}  // namespace
}  // namespace irradiff
