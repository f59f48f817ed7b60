#include "derivatives/error_metric/reprojection.h"

#include "derivatives/error_metric/epipolar_slices.h"
#include "derivatives/estimators/strata_sums.h"
#include "tests/estimators/sampled_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kCells = EpipolarGrid::kCells;
constexpr std::size_t kSlices = EpipolarGrid::kSlices;
constexpr double kCellMeasure = 0.5 * std::numbers::pi / static_cast<double>(kCells);
/// What epipolar_slices.h promises, of radiance 1.
constexpr double kRounding = 1e-6;

const Strata kStrata(Stratification::kConcentric, {64, 64});
const Vector3d kOrigin = Vector3d::Zero();

double irradianceOf(const HemisphereSamples& samples) {
  return StrataSums(samples.stratification, samples.shape).irradiance(samples);
}

Vector2d step(double distance, double angle) { return distance * Vector2d(std::cos(angle), std::sin(angle)); }

/// A square lamp at height 2 right above the origin; a black square half as high beside the lines of sight to it.
std::vector<Polygon> lampAndOccluder() {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  return {parallelogram("lamp", Vector3d(0, 0, 2), 0.3 * x, 0.3 * y, 1.0),
          parallelogram("occluder", Vector3d(0.5, 0, 1), 0.25 * x, 0.5 * y, 0.0)};
}

/// The slices for a step along t, in double, with and without hiding what is farther: walls keep their order, and what
/// has negative size counts so.
double signedSum(const HemisphereSamples& samples, double distance, bool hides) {
  const EpipolarGrid grid(kStrata, 0.0);
  const auto cell = [&](std::size_t i, std::size_t j) { return grid.strata()[i * kSlices + j]; };
  double sum = 0.0;
  for (std::size_t j = 0; j < kSlices; ++j) {
    double rearmost = std::numeric_limits<double>::infinity();
    double measure = 0.25 * std::numbers::pi;
    for (std::size_t i = kCells; i-- > 0;) {
      double next = -0.25 * std::numbers::pi;
      if (i > 0) {
        // Half way between the samples' own cosines, which the cells' walls are not.
        const double cosine = 0.5 * (samples.direction_t[cell(i, j)] + samples.direction_t[cell(i - 1, j)]);
        const double sine = std::sqrt(1.0 - cosine * cosine);
        const double nearer = std::max(samples.inverse_distance[cell(i, j)], samples.inverse_distance[cell(i - 1, j)]);
        const double place = (cosine - distance * nearer) / sine;
        rearmost = hides ? std::min(rearmost, place) : place;
        next = 0.5 * (rearmost / (1.0 + rearmost * rearmost) + std::atan(rearmost));
      }
      sum += samples.radiance[cell(i, j)] * (measure - next) * 2.0 / static_cast<double>(kSlices);
      measure = next;
    }
  }
  return sum;
}

TEST(Reprojection, OfConstantRadianceIsConstant) {
  for (const Stratification stratification : kAllStratifications) {
    const HemisphereSamples samples =
        sampleScene(room(1.0), frameAt({0.3, -0.2, 0.0}), strataOfSize(stratification, 64), SamplePlaces::jittered(3));
    const Reprojection reprojection(samples);
    for (const double distance : {0.0, 0.01, 0.2, 0.6}) {
      for (const double angle : {0.0, 0.7, 2.5, 4.4}) {
        EXPECT_NEAR(reprojection.irradiance(step(distance, angle)), std::numbers::pi, kRounding);
      }
    }
  }
}

/// Each slice crosses the border of a convex region twice. The wall that stands for a border is in the cell whose
/// sample is the first beyond it; the middle of the cell and its sample are in one stratum, which is as large as a cell
/// and a half across. So it is off by two cells at most, and by that times what the region grows by as it comes near.
TEST(Reprojection, FollowsALitWallToWithinCells) {
  std::vector<Polygon> scene = room(0.0);
  scene[0].radiance = 1.0;
  const Vector3d from(-0.4, 0.1, 0.0);
  const HemisphereSamples samples = sampleScene(scene, frameAt(from), kStrata, SamplePlaces::jittered(5));
  const Reprojection reprojection(samples);
  double worst = 0.0;
  double still = 0.0;  // the bad twin: nothing moves
  for (const double distance : {0.0, 0.1, 0.3, 0.6, 0.9}) {
    for (const double angle : {0.0, 0.8, 2.3, 3.9}) {
      const Vector2d moved = step(distance, angle);
      const Vector3d to = from + Vector3d(moved.x(), moved.y(), 0.0);
      if (to.head<2>().cwiseAbs().maxCoeff() > 0.9) continue;
      const double growth = std::max(1.0, (1.0 - from.x()) / (1.0 - to.x()));
      const double bound = 2.0 * 2.0 * 2.0 * kCellMeasure * growth;
      const double truth = trueDerivatives(scene, frameAt(to)).irradiance;
      worst = std::max(worst, std::abs(reprojection.irradiance(moved) - truth) / bound);
      still = std::max(still, std::abs(reprojection.irradiance(Vector2d::Zero()) - truth) / bound);
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1.0);
  EXPECT_GT(still, 1.0);
}

TEST(Reprojection, WithoutAStepIsTheIrradianceOfTheSamples) {
  for (const Stratification stratification : kAllStratifications) {
    std::vector<Polygon> scene = room(0.0);
    scene[2].radiance = 1.0;
    const HemisphereSamples samples =
        sampleScene(scene, frameAt({0.2, 0.3, 0.0}), strataOfSize(stratification, 64), SamplePlaces::jittered(6));
    const double irradiance = irradianceOf(samples);
    const double bound = 2.0 * 2.0 * 2.0 * kCellMeasure;
    EXPECT_NEAR(Reprojection(samples).irradiance(Vector2d::Zero()), irradiance, bound);
    // The bad twin: that of a point nearby.
    EXPECT_GT(std::abs(Reprojection(samples).irradiance({0.0, 0.4}) - irradiance), bound);
  }
}

TEST(Reprojection, SeesAnOccluderThatComesToCoverALampAStepAway) {
  const std::vector<Polygon> scene = lampAndOccluder();
  const HemisphereSamples samples = sampleScene(scene, frameAt(kOrigin), kStrata, SamplePlaces::jittered(7));
  const double here = trueDerivatives(scene, frameAt(kOrigin)).irradiance;
  const double distance = 1.0;
  const double truth = trueDerivatives(scene, frameAt({distance, 0, 0})).irradiance;
  // Half of the lamp and more is hidden there, and nothing of it here: the Hessian sees nothing of that.
  std::vector<Polygon> lamp_alone = {scene[0]};
  const double unhidden = trueDerivatives(lamp_alone, frameAt({distance, 0, 0})).irradiance;
  ASSERT_LT(truth, 0.5 * unhidden);
  ASSERT_DOUBLE_EQ(here, trueDerivatives(lamp_alone, frameAt(kOrigin)).irradiance);

  const double middle = 0.5 * (truth + unhidden);
  EXPECT_LT(Reprojection(samples).irradiance({distance, 0.0}), middle);
  EXPECT_LT(signedSum(samples, distance, true), middle);
  EXPECT_GT(signedSum(samples, distance, false), middle);
}

/// What a mirror does to the scene it does to the step.
TEST(Reprojection, LooksBehindAsItLooksAhead) {
  const std::vector<Polygon> scene = lampAndOccluder();
  std::vector<Polygon> mirrored = scene;
  for (Polygon& polygon : mirrored) {
    for (Vector3d& vertex : polygon.vertices) vertex.x() = -vertex.x();
  }
  const HemisphereSamples samples = sampleScene(scene, frameAt(kOrigin), kStrata, SamplePlaces::centred());
  const HemisphereSamples reflected = sampleScene(mirrored, frameAt(kOrigin), kStrata, SamplePlaces::centred());
  EpipolarSlices slices;
  EpipolarSlices mirror;
  const EpipolarGrid grid(kStrata, 0.0);
  slices.fill(grid, samples, 1.0);
  mirror.fill(grid, reflected, 1.0);
  for (const double distance : {0.0, 0.02, 0.3, 0.8, 1.1, 1.7}) {
    EXPECT_NEAR(slices.irradiance(distance), mirror.irradiance(-distance), 2.0 * kRounding);
    EXPECT_NEAR(slices.irradiance(-distance), mirror.irradiance(distance), 2.0 * kRounding);
  }
}

TEST(Reprojection, SlopeIsTheDerivativeOfTheIrradiance) {
  const HemisphereSamples samples =
      sampleScene(lampAndOccluder(), frameAt({0.7, 0.1, 0.0}), kStrata, SamplePlaces::jittered(2));
  for (const double azimuth : {0.0, 0.9, 2.2}) {
    EpipolarSlices slices;
    slices.fill(EpipolarGrid(kStrata, azimuth), samples, 1.0);
    const double slope = slices.slope();
    ASSERT_GT(std::abs(slope), 0.01);
    // Second differences are about 1/m^4 here; each irradiance has its rounding.
    const double h = 0.01;
    for (const double side : {1.0, -1.0}) {
      const double difference = (slices.irradiance(side * h) - slices.irradiance(0.0)) / (side * h);
      EXPECT_NEAR(difference, slope, h + 2.0 * kRounding / h);
    }
  }
}

TEST(Reprojection, KnowsHowFarThePlaneIsFree) {
  const HemisphereSamples samples =
      sampleScene(room(1.0), frameAt({0.3, -0.2, 0.0}), kStrata, SamplePlaces::jittered(3));
  const Reprojection reprojection(samples);
  for (int k = 0; k < 40; ++k) {
    const double angle = 0.05 + 2.0 * std::numbers::pi * k / 40;
    // The sample's azimuth is within its stratum: 252 strata around the horizon, none more than twice as wide as most.
    std::array<double, 2> ends{};
    for (std::size_t end = 0; end < 2; ++end) {
      const double turned = angle + (end == 0 ? -1.0 : 1.0) * 2.0 * 2.0 * std::numbers::pi / 252;
      const double t = std::cos(turned) > 0 ? 0.7 / std::cos(turned) : -1.3 / std::cos(turned);
      const double b = std::sin(turned) > 0 ? 1.2 / std::sin(turned) : -0.8 / std::sin(turned);
      ends[end] = std::min(t, b);
    }
    const double found = reprojection.freeDistance(angle);
    // A corner of the room may lie between the ends.
    EXPECT_GE(found, 0.9 * std::min(ends[0], ends[1]));
    EXPECT_LE(found, 1.1 * std::max(ends[0], ends[1]));
  }
  HemisphereSamples misses = uniformSamples(kStrata, 1.0, 0.0);
  std::ranges::fill(misses.inverse_distance, 0.0);
  EXPECT_TRUE(std::isinf(Reprojection(misses).freeDistance(1.0)));
}

TEST(ReprojectedErrors, AreWhatTheFirstOrderLeavesOut) {
  const HemisphereSamples samples =
      sampleScene(lampAndOccluder(), frameAt(kOrigin), kStrata, SamplePlaces::jittered(4));
  const std::vector<double> distances{0.1, 0.4, 1.0, 1.6};
  const std::size_t directions = 6;
  const ErrorProfile profile =
      ReprojectedErrors(Stratification::kConcentric, kStrata.shape(), directions).profile(samples, distances);
  ASSERT_EQ(profile.directions(), directions);
  ASSERT_EQ(profile.distances, distances);
  const Reprojection reprojection(samples);
  const double here = reprojection.irradiance(Vector2d::Zero());
  double largest = 0.0;
  for (std::size_t k = 0; k < directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(directions);
    EpipolarSlices slices;
    slices.fill(EpipolarGrid(kStrata, angle), samples, 1.0);
    for (std::size_t m = 0; m < distances.size(); ++m) {
      const double error =
          std::abs(reprojection.irradiance(step(distances[m], angle)) - here - distances[m] * slices.slope());
      // Opposite azimuths have the same cells but for samples on the border of strata: some of 4096 cells.
      EXPECT_NEAR(profile.errors[k * distances.size() + m], error, 8.0 * kCellMeasure * 2.0 / kSlices);
      largest = std::max(largest, error);
    }
  }
  EXPECT_GT(largest, 0.05);
}

TEST(ReprojectedErrors, AreZeroInTheDarkAndWhereNothingIsNear) {
  const ReprojectedErrors errors(Stratification::kConcentric, kStrata.shape());
  const std::vector<double> distances{0.1, 0.5, 2.0};
  HemisphereSamples lit_misses = uniformSamples(kStrata, 1.0, 1.0);
  for (std::size_t i = 0; i < lit_misses.radiance.size(); ++i) {
    lit_misses.inverse_distance[i] = 0.0;
    lit_misses.radiance[i] = lit_misses.direction_t[i] > 0.3 ? 2.0 : 0.5;
  }
  for (const float error : errors.profile(lit_misses, distances).errors) EXPECT_LE(error, 4.0 * kRounding);
  for (const float error : errors.profile(uniformSamples(kStrata, 1.0, 0.0), distances).errors) EXPECT_EQ(error, 0.0f);
}

TEST(ReprojectedErrors, EndAtAWall) {
  std::vector<Polygon> scene = room(0.2);
  scene[1].radiance = 1.0;
  const HemisphereSamples samples = sampleScene(scene, frameAt(kOrigin), kStrata, SamplePlaces::jittered(9));
  const std::vector<double> distances{0.3, 0.9, 1.1, 3.0};
  const ErrorProfile profile =
      ReprojectedErrors(Stratification::kConcentric, kStrata.shape(), 4).profile(samples, distances);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(profile.errors[k * 4], 0.0f);
    EXPECT_EQ(profile.errors[k * 4 + 2], 0.0f);
    EXPECT_EQ(profile.errors[k * 4 + 3], 0.0f);
  }
}

/// A slab at height 1 over the half plane x < 0, seen from the origin: at s ahead its edge is seen at the cotangent -s
/// in all slices, 1/(1 + s^2)^2 of measure a metre there. In the slices beside the line of motion the edge is at x = 0
/// too, at a height over the line of 1/sin psi; the slices are uniform in cos psi. So the rate at s = 0 is the integral
/// of sin psi d(cos psi) from -1 to 1, pi/2.
TEST(ReprojectedErrors, KnowHowFastHiddenThingsComeIntoView) {
  const std::vector<Polygon> scene = {
      parallelogram("slab", Vector3d(-500.0, 0, 1), 500.0 * Vector3d::UnitX(), 1000.0 * Vector3d::UnitY(), 0.0)};
  const HemisphereSamples samples = sampleScene(scene, frameAt(kOrigin), kStrata, SamplePlaces::centred());
  const std::vector<double> distances{0.1, 0.5};
  const ReprojectedError error =
      ReprojectedErrors(Stratification::kConcentric, kStrata.shape(), 4).predict(samples, distances);
  // Samples and cells: the edge is off by a cell of 1/64 at most, where the cosine's root changes it less.
  EXPECT_NEAR(error.hidden[0], 0.5 * std::numbers::pi, 0.5 * std::numbers::pi / 32.0);
  EXPECT_LT(error.hidden[2], 0.2);
  for (const float remainder : error.remainders) EXPECT_EQ(remainder, 0.0f);
  const ErrorProfile profile = error.profile(3.0);
  const double measure = 0.5 * static_cast<double>(error.hidden[0]);
  EXPECT_NEAR(profile.errors[1], 3.0 * measure * measure / kHiddenMeasure, 1e-6);
  EXPECT_NEAR(profile.errors[1], 25.0f * profile.errors[0], 1e-5);
}

/// Powers of two change no bit.
TEST(ReprojectedErrors, DoNotDependOnTheUnits) {
  const HemisphereSamples samples =
      sampleScene(lampAndOccluder(), frameAt({0.6, 0.2, 0.0}), kStrata, SamplePlaces::jittered(4));
  const ReprojectedErrors errors(Stratification::kConcentric, kStrata.shape(), 4);
  const std::vector<double> distances{0.1, 0.4, 1.0};
  const ErrorProfile expected = errors.profile(samples, distances);
  for (const int exponent : {-300, 40, 300}) {
    HemisphereSamples scaled = samples;
    std::vector<double> scaled_distances;
    for (const double distance : distances) scaled_distances.push_back(std::ldexp(distance, exponent));
    for (double& inverse : scaled.inverse_distance) inverse = std::ldexp(inverse, -exponent);
    for (double& radiance : scaled.radiance) radiance = std::ldexp(radiance, 7);
    const ErrorProfile profile = errors.profile(scaled, scaled_distances);
    for (std::size_t i = 0; i < expected.errors.size(); ++i) {
      EXPECT_EQ(profile.errors[i], std::ldexp(expected.errors[i], 7));
    }
  }
}

/// Four directions; numbers that floats hold. Walls at 3 m along b and at 0.75 m along -t.
ReprojectedError someError() {
  constexpr double kFree = std::numeric_limits<double>::infinity();
  return {
      {0.5, 1.0, 2.0}, {1, -2, 4, 3, 5, -7, 2, 0, 0, -4, 8, 16}, {0.25f, 0.5f, 0.0f, 1.0f}, {kFree, 3.0, 0.75, kFree}};
}

/// Between the values of two directions and two distances, written out by hand.
TEST(ReprojectedErrors, RemaindersAreLinearBetweenWhatIsTabulated) {
  const ReprojectedError error = someError();
  const double quarter = 0.5 * std::numbers::pi;
  // At nodes they are the values of the table, with their signs.
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t m = 0; m < 3; ++m) {
      if (error.distances[m] >= error.free_distances[k]) continue;
      const std::optional<double> there =
          error.remainder(step(error.distances[m] * (1.0 - 1e-14), quarter * static_cast<double>(k)));
      ASSERT_TRUE(there);
      EXPECT_NEAR(*there, static_cast<double>(error.remainders[k * 3 + m]), 1e-12) << k << ' ' << m;
      // Bad twin: the direction after.
      EXPECT_GT(std::abs(*there - static_cast<double>(error.remainders[(k + 1) % 4 * 3 + m])), 0.5);
    }
  }
  // Half way between distances: (-2 + 4)/2 along t, (5 - 7)/2 along b, and between these directions their mean.
  EXPECT_NEAR(*error.remainder(step(1.5, 0.0)), 1.0, 1e-12);
  EXPECT_NEAR(*error.remainder(step(1.5, quarter)), -1.0, 1e-12);
  EXPECT_NEAR(*error.remainder(step(1.5, 0.5 * quarter)), 0.0, 1e-12);
  EXPECT_NEAR(*error.remainder(step(1.5, 0.25 * quarter)), 0.5, 1e-12);
  // From the last direction on to the first: -4 and 1, 8 and -2.
  EXPECT_NEAR(*error.remainder(step(0.5, -0.25 * quarter)), 0.75 * 1.0 + 0.25 * -4.0, 1e-12);
  EXPECT_NEAR(*error.remainder(step(1.0, 3.25 * quarter)), 0.75 * 8.0 + 0.25 * -2.0, 1e-12);
}

TEST(ReprojectedErrors, RemaindersBeginQuadratically) {
  const ReprojectedError error = someError();
  for (const double angle : {0.0, 0.4, 1.1, 4.9}) {
    const double whole = *error.remainder(step(0.5 * (1.0 - 1e-14), angle));
    ASSERT_GT(std::abs(whole), 0.1);
    for (const double share : {0.5, 0.25, 0.01}) {
      const double part = *error.remainder(step(0.5 * share, angle));
      EXPECT_NEAR(part, share * share * whole, 1e-12);
      EXPECT_GT(std::abs(part - share * whole), 1e-4) << "bad twin: linear";
    }
  }
  EXPECT_EQ(*error.remainder(Vector2d::Zero()), 0.0);
}

TEST(ReprojectedErrors, HaveNoRemaindersBeyondWhatIsFreeOrTabulated) {
  const ReprojectedError error = someError();
  const double quarter = 0.5 * std::numbers::pi;
  EXPECT_TRUE(error.remainder(step(1.999, 0.0)));
  EXPECT_FALSE(error.remainder(step(2.001, 0.0)));
  EXPECT_TRUE(error.remainder(step(0.74, 2.0 * quarter)));
  EXPECT_FALSE(error.remainder(step(0.76, 2.0 * quarter)));
  // The nearest direction decides, and only what is free takes part: along b at 1 m it is 5, not a mean with 0.
  EXPECT_FALSE(error.remainder(step(1.0, 1.6 * quarter)));
  EXPECT_NEAR(*error.remainder(step(1.0, 1.4 * quarter)), 5.0, 1e-12);
  EXPECT_NEAR(*error.remainder(step(1.0, 2.6 * quarter)), 8.0, 1e-12);
  // Bad twin: a table without walls.
  ReprojectedError open = error;
  std::ranges::fill(open.free_distances, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(open.remainder(step(1.0, 1.6 * quarter)));
  EXPECT_NEAR(*open.remainder(step(1.0, 1.4 * quarter)), 0.6 * 5.0, 1e-12);
}

TEST(ReprojectedErrors, ProfileIsWhatRemaindersAreWithoutSigns) {
  const HemisphereSamples samples =
      sampleScene(lampAndOccluder(), frameAt(kOrigin), kStrata, SamplePlaces::jittered(4));
  const std::vector<double> distances{0.1, 0.4, 1.0, 1.6};
  const ReprojectedError error =
      ReprojectedErrors(Stratification::kConcentric, kStrata.shape(), 6).predict(samples, distances);
  const ErrorProfile seen = error.profile(0.0);
  double lowest = 0.0;
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t m = 0; m < distances.size(); ++m) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / 6.0;
      const double remainder = *error.remainder(step(distances[m] * (1.0 - 1e-14), angle));
      EXPECT_NEAR(std::abs(remainder), static_cast<double>(seen.errors[k * distances.size() + m]), 1e-10);
      lowest = std::min(lowest, remainder);
    }
  }
  EXPECT_LT(lowest, -0.05) << "signs: the occluder takes light away";
}

/// Radiance times m^2 over the measure in which surroundings change, before walls alone.
TEST(ReprojectedErrors, AddWhatIsHidden) {
  const ReprojectedError error = someError();
  ErrorProfile profile{error.distances, std::vector<float>(12, 1.0f)};
  error.addHidden(3.0, profile);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t m = 0; m < 3; ++m) {
      const double measure = static_cast<double>(error.hidden[k]) * error.distances[m];
      const bool is_free = error.distances[m] < error.free_distances[k];
      const double added = is_free ? 3.0 * measure * measure / kHiddenMeasure : 0.0;
      EXPECT_NEAR(static_cast<double>(profile.errors[k * 3 + m]), 1.0 + added, 1e-5);
    }
  }
  EXPECT_GT(profile.errors[11], 20.0f);
  const ErrorProfile whole = error.profile(3.0);
  EXPECT_NEAR(static_cast<double>(whole.errors[1]), 2.0 + 3.0 * 0.25 * 0.25 / kHiddenMeasure, 1e-5);
}

TEST(ReprojectedErrors, AreFiniteWhateverIsSeen) {
  const ReprojectedErrors errors(Stratification::kConcentric, kStrata.shape(), 4);
  HemisphereSamples samples = sampleScene(lampAndOccluder(), frameAt(kOrigin), kStrata, SamplePlaces::centred());
  const std::array<double, 6> inverse_distances{0.0, 1e-310, 1e-30, 1.0, 1e30, 1e300};
  for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
    samples.inverse_distance[i] = inverse_distances[i % 6];
    samples.radiance[i] = i % 5 == 0 ? 1e30 : 1e-30;
  }
  // On the horizon, and along the line of motion.
  samples.direction_t[0] = 1.0;
  samples.direction_b[0] = samples.direction_n[0] = 0.0;
  const std::vector<double> distances{1e-200, 1e-3, 1.0, 1e5};
  for (const float error : errors.profile(samples, distances).errors) {
    EXPECT_TRUE(std::isfinite(error));
    EXPECT_GE(error, 0.0f);
  }
}

TEST(ReprojectedErrors, RefuseAnOddNumberOfDirections) {
  for (const std::size_t directions : {std::size_t{0}, std::size_t{7}}) {
    EXPECT_THROW(ReprojectedErrors(Stratification::kConcentric, kStrata.shape(), directions), std::invalid_argument);
  }
}

}  // namespace
}  // namespace irradiff
