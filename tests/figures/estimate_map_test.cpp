#include "experiments/figures/estimate_map.h"

#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "tests/cli/program_run.h"
#include "tests/figures/small_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

const std::vector<std::string> kEstimators{"ward-heckbert", "triangulated"};

std::vector<Polygon> lampAndScreen() {
  return {{"lamp", {{0.1, 0.2, 1}, {0.9, 0.3, 1}, {0.8, 0.7, 1}, {0.2, 0.9, 1}}, 2.5},
          {"screen", {{0.3, 0.3, 0.5}, {0.6, 0.3, 0.5}, {0.6, 0.7, 0.6}}, 0.0}};
}

SamplingPlan planOf(std::size_t side, std::uint64_t seed) {
  return {Stratification::kConcentric, {side, side}, SamplePattern::kJittered, seed};
}

bool areEqual(const std::vector<EstimateMap>& a, const std::vector<EstimateMap>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t m = 0; m < a.size(); ++m) {
    for (std::size_t i = 0; i < a[m].values.size(); ++i) {
      for (std::size_t k = 0; k < kEstimateValueCount; ++k) {
        const double x = a[m].values[i][k];
        const double y = b[m].values[i][k];
        if (!(x == y) && !(std::isnan(x) && std::isnan(y))) return false;
      }
    }
  }
  return true;
}

TEST(EstimateMap, HasWhatTheEstimatorSaysOfEachReceiversOwnSamples) {
  const std::vector<Polygon> polygons = lampAndScreen();
  const ReceiverGrid grid = unitGrid(4, 3);
  const std::vector<EstimateMap> maps = estimateMaps(polygons, grid, planOf(8, 3), kEstimators, 2, nullptr, 0);
  ASSERT_EQ(maps.size(), 2U);
  const RayCaster caster(polygons);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(maps[m].estimator, kEstimators[m]);
    const auto estimator = makeEstimator(kEstimators[m], Stratification::kConcentric, {8, 8});
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        // Ray by ray, in a frame written out.
        const SampleFrame frame{{(static_cast<double>(i) + 0.5) / 4.0, (static_cast<double>(j) + 0.5) / 3.0, 0.0},
                                {1, 0, 0},
                                {0, 1, 0},
                                {0, 0, 1}};
        const ReceiverRays rays = caster.from(frame);
        const HemisphereSamples samples = sampleHemisphere(Strata(Stratification::kConcentric, {8, 8}),
                                                           SamplePattern::kJittered, 3, j * 4 + i, frame, rays.query());
        const IrradianceEstimate estimate = estimator->estimate(samples);
        const EstimateValues& found = maps[m].values[j * 4 + i];
        EXPECT_EQ(found[kEstimateE], estimate.irradiance);
        EXPECT_EQ(found[kEstimateGradientX], estimate.gradient->x());
        EXPECT_EQ(found[kEstimateGradientY], estimate.gradient->y());
        EXPECT_EQ(std::isnan(found[kEstimateGradientZ]), !estimate.knows_normal_component);
        if (!estimate.tangential_hessian) {
          EXPECT_TRUE(std::isnan(found[kEstimateHessianXX]));
          continue;
        }
        EXPECT_EQ(found[kEstimateHessianXX], (*estimate.tangential_hessian)(0, 0));
        EXPECT_EQ(found[kEstimateHessianYY], (*estimate.tangential_hessian)(1, 1));
      }
    }
  }
}

TEST(EstimateMap, EigenvaluesAreThoseOfTheHessianInSpace) {
  IrradianceEstimate estimate;
  estimate.hessian = Eigen::Vector3d(-4, 3, 1).asDiagonal();
  // Of what is not symmetric to rounding, the symmetric part.
  (*estimate.hessian)(0, 1) = 1e-3;
  (*estimate.hessian)(1, 0) = -1e-3;
  const EstimateValues values = valuesOf(estimate);
  EXPECT_NEAR(values[kEstimateLambda1], 3.0, 1e-14);
  EXPECT_NEAR(values[kEstimateLambda2], 1.0, 1e-14);
  EXPECT_NEAR(values[kEstimateLambda3], -4.0, 1e-14);
  EXPECT_TRUE(std::isnan(values[kEstimateGradientX]));
  EXPECT_TRUE(std::isnan(values[kEstimateHessianXX]));
}

TEST(EstimateMap, DependsOnTheSeedAndNotOnThreadsOrCompany) {
  const std::vector<Polygon> polygons = lampAndScreen();
  const ReceiverGrid grid = unitGrid(5, 7);
  const auto mapsWith = [&](std::uint64_t seed, unsigned threads, const std::vector<std::string>& names) {
    return estimateMaps(polygons, grid, planOf(6, seed), names, threads, nullptr, 0);
  };
  const std::vector<EstimateMap> maps = mapsWith(1, 1, kEstimators);
  EXPECT_TRUE(areEqual(maps, mapsWith(1, 3, kEstimators)));
  EXPECT_FALSE(areEqual(maps, mapsWith(2, 1, kEstimators)));
  EXPECT_TRUE(areEqual({maps[1]}, mapsWith(1, 2, {"triangulated"})));
}

TEST(EstimateMap, GoesOnFromFinishedRows) {
  const ScratchFolder scratch;
  const std::vector<Polygon> polygons = lampAndScreen();
  const ReceiverGrid grid = unitGrid(3, 4);
  const std::vector<EstimateMap> maps = estimateMaps(polygons, grid, planOf(6, 1), kEstimators, 1, nullptr, 0);
  const TileStore store(scratch.file("work"), "this");
  const auto resumed = [&] { return estimateMaps(polygons, grid, planOf(6, 1), kEstimators, 2, &store, 10); };
  EXPECT_TRUE(areEqual(resumed(), maps));
  EXPECT_TRUE(areEqual(resumed(), maps)) << "from the rows alone";
  // A row that says something else is believed: it was not computed again.
  std::vector<double> row = store.read(12, 3 * 2 * kEstimateValueCount).value();
  row[kEstimateE] = 77.0;
  store.write(12, row);
  EXPECT_EQ(resumed()[0].values[2 * 3][kEstimateE], 77.0);
  std::filesystem::remove(scratch.file("work") / "tile-12");
  EXPECT_TRUE(areEqual(resumed(), maps)) << "what is missing is computed";
}

TEST(EstimateMap, KnowsWhatTakesWhichSamples) {
  const std::vector<std::string> concentric = estimatorsFor(Stratification::kConcentric);
  const std::vector<std::string> hemicube = estimatorsFor(Stratification::kHemicube);
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::ranges::find(names, name) != names.end();
  };
  EXPECT_TRUE(has(concentric, "triangulated"));
  EXPECT_FALSE(has(concentric, "hemicube"));
  EXPECT_TRUE(has(hemicube, "hemicube"));
  EXPECT_THROW(pointEstimator("hemicube", Stratification::kConcentric, {4, 4}), std::invalid_argument);
}

}  // namespace
}  // namespace irradiff
