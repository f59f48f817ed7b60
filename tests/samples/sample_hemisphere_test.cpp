#include "derivatives/samples/sample_hemisphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;

const SampleFrame kFrame{{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// A lamp that fills all directions with t > b, 2 m away; nothing elsewhere.
RayHit halfSky(const Vector3d& direction) {
  return direction.x() > direction.y() ? RayHit{0.5, 3.0} : RayHit{0.0, 0.0};
}

struct Grid {
  Stratification stratification;
  GridShape shape;
};

const std::vector<Grid> kGrids = {
    {Stratification::kPolar, {5, 12}}, {Stratification::kConcentric, {7, 6}}, {Stratification::kHemicube, {24, 8}}};

TEST(SampleHemisphere, HasOneSampleInEachStratumRowByRow) {
  for (const auto& [stratification, shape] : kGrids) {
    const Strata strata(stratification, shape);
    for (const SamplePattern pattern :
         {SamplePattern::kCentred, SamplePattern::kJittered, SamplePattern::kLowDiscrepancy}) {
      std::vector<Vector3d> asked;
      const HemisphereSamples samples = sampleHemisphere(strata, pattern, 1, 2, kFrame, [&](const Vector3d& direction) {
        asked.push_back(direction);
        return halfSky(direction);
      });
      EXPECT_EQ(samples.shape, shape);
      EXPECT_EQ(samples.stratification, stratification);
      EXPECT_EQ(samples.frame.position, kFrame.position);
      EXPECT_EQ(samples.frame.axes(), Eigen::Matrix3d::Identity());
      ASSERT_EQ(asked.size(), shape.size());
      for (const auto* numbers : {&samples.direction_t, &samples.direction_b, &samples.direction_n,
                                  &samples.inverse_distance, &samples.radiance}) {
        ASSERT_EQ(numbers->size(), shape.size());
      }
      for (std::size_t k = 0; k < shape.size(); ++k) {
        EXPECT_EQ(samples.direction(k), asked[k]);
        const StratumPosition p = strata.position(asked[k]);
        EXPECT_EQ(p.row, k / shape.columns);
        EXPECT_EQ(p.column, k % shape.columns);
        const RayHit hit = halfSky(asked[k]);
        EXPECT_EQ(samples.inverse_distance[k], hit.inverse_distance);
        EXPECT_EQ(samples.radiance[k], hit.radiance);
      }
    }
  }
}

TEST(SampleHemisphere, DependsOnSeedAndPoint) {
  const Strata strata(Stratification::kConcentric, {8, 8});
  const auto directions = [&](std::uint64_t seed, std::uint64_t point) {
    return sampleHemisphere(strata, SamplePattern::kJittered, seed, point, kFrame, halfSky).direction_t;
  };
  EXPECT_EQ(directions(1, 2), directions(1, 2));
  EXPECT_NE(directions(1, 2), directions(1, 3));
  EXPECT_NE(directions(1, 2), directions(2, 2));
}

/// The sum of radiance times a stratum's projected solid angle, over many points.
double meanIrradiance(const Strata& strata, SamplePattern pattern, std::uint64_t points, double& standard_error) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t point = 0; point < points; ++point) {
    // Radiance n^2: its irradiance is the integral of cos^3, pi/2.
    const HemisphereSamples samples = sampleHemisphere(strata, pattern, 11, point, kFrame, [](const Vector3d& d) {
      return RayHit{1.0, d.z() * d.z()};
    });
    double irradiance = 0.0;
    for (std::size_t k = 0; k < samples.shape.size(); ++k) {
      irradiance +=
          samples.radiance[k] * strata.projectedSolidAngle(k / samples.shape.columns, k % samples.shape.columns);
    }
    sum += irradiance;
    squares += irradiance * irradiance;
  }
  const auto n = static_cast<double>(points);
  standard_error = std::sqrt((squares / n - sum / n * (sum / n)) / (n - 1));
  return sum / n;
}

TEST(SampleHemisphere, EstimatesIrradianceWithoutBiasOnEqualAreaStrata) {
  for (const SamplePattern pattern : {SamplePattern::kJittered, SamplePattern::kLowDiscrepancy}) {
    for (const Grid& grid : {kGrids[0], kGrids[1]}) {
      double standard_error = 0.0;
      const double mean = meanIrradiance(Strata(grid.stratification, grid.shape), pattern, 4000, standard_error);
      EXPECT_NEAR(mean, std::numbers::pi / 2, 4 * standard_error);
      EXPECT_LT(standard_error, 1e-3) << "too loose to notice anything";
    }
  }
}

TEST(SampleHemisphere, MiddlesOfStrataAreBiased) {
  // Middles of strata know no random error, only the midpoint rule's. The check above must see such an error.
  double standard_error = 0.0;
  const double mean =
      meanIrradiance(Strata(Stratification::kConcentric, {7, 6}), SamplePattern::kCentred, 2, standard_error);
  EXPECT_GT(std::abs(mean - std::numbers::pi / 2), 1e-3);
}

}  // namespace
}  // namespace irradiff
