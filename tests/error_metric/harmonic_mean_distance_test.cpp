#include "derivatives/error_metric/harmonic_mean_distance.h"

#include "derivatives/samples/sample_hemisphere.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irradiff {
namespace {

const SampleFrame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

double meanDistance(const Strata& strata, const std::function<double(const Eigen::Vector3d&)>& inverse_distance) {
  const HemisphereSamples samples =
      sampleHemisphere(strata, SamplePattern::kCentred, 1, 0, kFrame, [&](const Eigen::Vector3d& direction) {
        return RayHit{inverse_distance(direction), 1.0};
      });
  return harmonicMeanDistance(samples, strata);
}

const Strata kStrata[] = {Strata(Stratification::kPolar, {64, 256}), Strata(Stratification::kConcentric, {128, 128}),
                          Strata(Stratification::kHemicube, {192, 64})};

TEST(HarmonicMeanDistance, OfADomeIsItsRadius) {
  for (const Strata& strata : kStrata) {
    EXPECT_NEAR(meanDistance(strata, [](const Eigen::Vector3d&) { return 1.0 / 3.0; }), 3.0, 1e-12);
  }
}

/// Under a ceiling at height h, 1/r = cos/h, and 1/pi int cos^2/h dw = 2/(3 h).
TEST(HarmonicMeanDistance, UnderACeilingIsThreeHalvesOfItsHeight) {
  for (const Strata& strata : kStrata) {
    const double mean = meanDistance(strata, [](const Eigen::Vector3d& w) { return w(2) / 2.0; });
    // Midpoints of 64 rows: the second-order error is below 1/64^2; at the horizon cos is a root, so 1/64^1.5.
    EXPECT_NEAR(mean, 3.0, 3.0 * std::pow(64.0, -1.5));
  }
}

TEST(HarmonicMeanDistance, CountsAMissAsInfinitelyFar) {
  for (const Strata& strata : kStrata) {
    EXPECT_NEAR(meanDistance(strata, [](const Eigen::Vector3d& w) { return w(0) > 0.0 ? 0.5 : 0.0; }), 4.0, 1e-12);
    EXPECT_TRUE(std::isinf(meanDistance(strata, [](const Eigen::Vector3d&) { return 0.0; })));
  }
}

}  // namespace
}  // namespace irradiff
