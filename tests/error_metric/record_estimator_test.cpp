#include "derivatives/error_metric/record_estimator.h"

#include "derivatives/samples/sample_hemisphere.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr GridShape kShape{32, 32};
constexpr auto kStratification = Stratification::kConcentric;
/// Relative rounding of a sum over the strata.
const double kSumRounding = static_cast<double>(kShape.size()) * std::numeric_limits<double>::epsilon();
const SampleFrame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

const ErrorMetricDescription& metric(std::string_view name) {
  for (const ErrorMetricDescription& description : errorMetricDescriptions()) {
    if (description.name == name) return description;
  }
  throw std::logic_error("no such metric");
}

using Radiance = std::function<double(const Vector3d& point)>;

/// In a closed room, x in [-1, 0.7], y in [-0.8, 1.1], z in [0, 1.5], from the middle of the floor or so.
HemisphereSamples inRoom(const Radiance& radiance) {
  return sampleHemisphere(Strata(kStratification, kShape), SamplePattern::kCentred, 1, 0, kFrame,
                          [&](const Vector3d& w) {
                            const double x = w(0) > 0.0 ? w(0) / 0.7 : -w(0);
                            const double y = w(1) > 0.0 ? w(1) / 1.1 : -w(1) / 0.8;
                            const double inverse = std::max({x, y, w(2) / 1.5});
                            return RayHit{inverse, radiance(w / inverse)};
                          });
}

double oneWallBright(const Vector3d& point) { return point(0) > 0.699 ? 3.0 : 0.1; }
double black(const Vector3d&) { return 0.0; }
double one(const Vector3d&) { return 1.0; }

Matrix2d plainHessian(std::string_view estimator, const HemisphereSamples& samples) {
  return *makeEstimator(estimator, kStratification, kShape)->estimate(samples).tangential_hessian;
}

double largestEntry(const Matrix2d& matrix) { return matrix.cwiseAbs().maxCoeff(); }

TEST(RecordEstimator, AddsTheShareOfTheMeanRadianceToEveryHit) {
  const HemisphereSamples samples = inRoom(oneWallBright);
  for (const char* name : {"radiometric-hessian", "occlusion-hessian"}) {
    for (const double share : {0.0, 0.01, 0.3}) {
      const RecordDerivatives record = RecordEstimator(metric(name), kStratification, kShape, share).estimate(samples);
      // Hessians are linear in radiance: that of the samples, and a multiple of that of radiance 1.
      const double mean = record.irradiance.value / std::numbers::pi;
      const std::string_view estimator = metric(name).estimator;
      const Matrix2d ones = plainHessian(estimator, inRoom(one));
      const Matrix2d expected = plainHessian(estimator, samples) + share * mean * ones;
      const double rounding = kSumRounding * largestEntry(expected);
      EXPECT_LE(largestEntry(record.tangential_hessian->value - expected), rounding);
      // The share of E in place of E/pi is seen.
      const Matrix2d twin = plainHessian(estimator, samples) + share * record.irradiance.value * ones;
      if (share > 0.0) {
        EXPECT_GT(largestEntry(record.tangential_hessian->value - twin), 1e6 * rounding);
      }
    }
  }
}

TEST(RecordEstimator, LeavesTheIrradianceAsItIsUnlessItIsZero) {
  const HemisphereSamples lit = inRoom(oneWallBright);
  const double expected = makeEstimator("ward-heckbert", kStratification, kShape)->estimate(lit).irradiance;
  for (const ErrorMetricDescription& each : errorMetricDescriptions()) {
    EXPECT_DOUBLE_EQ(RecordEstimator(each, kStratification, kShape).estimate(lit).irradiance.value, expected);
  }
  const RecordDerivatives dark =
      RecordEstimator(metric("occlusion-hessian"), kStratification, kShape).estimate(inRoom(black));
  EXPECT_NEAR(dark.irradiance.value, std::numbers::pi, kSumRounding * std::numbers::pi);
}

TEST(RecordEstimator, GivesABlackRecordTheRegionOfRadianceOne) {
  ErrorMetricOptions options;
  options.threshold = 0.05;
  for (const char* name : {"radiometric-hessian", "geometric-hessian", "occlusion-hessian"}) {
    const RecordEstimator estimator(metric(name), kStratification, kShape, 0.0);
    const ErrorMetric chosen(name, options);
    const ValidRegion dark = chosen.region(estimator.estimate(inRoom(black)));
    const ValidRegion lit = chosen.region(estimator.estimate(inRoom(one)));
    EXPECT_EQ(dark.half_axes, lit.half_axes) << name;
    EXPECT_EQ(dark.axes, lit.axes) << name;
    EXPECT_TRUE(dark.half_axes.allFinite()) << name;
  }
}

/// In a closed room a constant adds nothing to the Hessian. What the 1 % does to the open mesh is the mesh's error.
TEST(RecordEstimator, HasNoFallbackWhereConstantRadianceGivesNothing) {
  const ErrorMetricDescription& occlusion = metric("occlusion-hessian");
  const double open = largestEntry(
      RecordEstimator(occlusion, kStratification, kShape).estimate(inRoom(black)).tangential_hessian->value);
  const RecordDerivatives closed =
      RecordEstimator(occlusion, "triangulated-closed", kStratification, kShape).estimate(inRoom(black));
  std::cout << "black room of radiance 1, 1024 rays: |H| = " << open << " (open mesh), "
            << largestEntry(closed.tangential_hessian->value) << " (closed)\n";
  EXPECT_GT(open, 0.01);
  EXPECT_EQ(largestEntry(closed.tangential_hessian->value), 0.0);
  ErrorMetricOptions options;
  options.threshold = 0.05;
  EXPECT_TRUE(std::isinf(ErrorMetric(occlusion.name, options).region(closed).half_axes(0)));
}

TEST(RecordEstimator, OfTheGeometricHessianTheRelativeRegionDoesNotSeeRadiance) {
  ErrorMetricOptions options;
  options.threshold = 0.05;
  const auto region = [&](std::string_view name, const Radiance& radiance) {
    return ErrorMetric(name, options)
        .region(RecordEstimator(metric(name), kStratification, kShape, 0.0).estimate(inRoom(radiance)));
  };
  const Eigen::Vector2d one_wall = region("geometric-hessian", oneWallBright).half_axes;
  EXPECT_LE((one_wall - region("geometric-hessian", one).half_axes).cwiseAbs().maxCoeff(), kSumRounding * one_wall(1));
  const Eigen::Vector2d seen = region("radiometric-hessian", oneWallBright).half_axes;
  EXPECT_GT((seen - region("radiometric-hessian", one).half_axes).cwiseAbs().maxCoeff(), 0.01 * seen(1));
}

TEST(RecordEstimator, GivesEachMetricWhatItTakes) {
  const HemisphereSamples samples = inRoom(oneWallBright);
  for (const ErrorMetricDescription& each : errorMetricDescriptions()) {
    const RecordDerivatives record = RecordEstimator(each, kStratification, kShape).estimate(samples);
    EXPECT_EQ(record.harmonic_mean_distance.has_value(), each.takes_distance) << each.name;
    EXPECT_EQ(record.tangential_gradient.has_value(), each.takes_gradient) << each.name;
    EXPECT_EQ(record.tangential_hessian.has_value(), each.takes_hessian) << each.name;
    if (each.takes_hessian) {
      EXPECT_EQ(record.tangential_hessian->value(0, 1), record.tangential_hessian->value(1, 0)) << each.name;
    }
  }
}

/// A miss has no surface that could shine.
TEST(RecordEstimator, LeavesMissesDark) {
  const auto half =
      sampleHemisphere(Strata(kStratification, kShape), SamplePattern::kCentred, 1, 0, kFrame, [](const Vector3d& w) {
        return RayHit{w(0) > 0.0 ? 0.5 : 0.0, 0.0};
      });
  const RecordDerivatives record = RecordEstimator(metric("geometric-hessian"), kStratification, kShape).estimate(half);
  EXPECT_NEAR(record.irradiance.value, 0.5 * std::numbers::pi, kSumRounding * std::numbers::pi);
}

TEST(RecordEstimator, RefusesWhatHasNoMeaning) {
  for (const double share :
       {-0.01, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT([share] { RecordEstimator(metric("occlusion-hessian"), kStratification, kShape, share); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("must be finite and >= 0")));
  }
  EXPECT_THAT([] { RecordEstimator(metric("split-sphere"), "geometric", kStratification, kShape); },
              ThrowsMessage<std::invalid_argument>("error metric split-sphere: takes no derivatives, given estimator "
                                                   "geometric"));
  EXPECT_THAT([] { RecordEstimator(metric("occlusion-hessian"), "no-such", kStratification, kShape); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("unknown estimator \"no-such\"")));
}

}  // namespace
}  // namespace irradiff
