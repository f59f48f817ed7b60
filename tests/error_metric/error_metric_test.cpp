#include "derivatives/error_metric/error_metric.h"

#include "tests/error_metric/ellipse_quadrature.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff::error_metric_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ErrorMetricOptions withThreshold(double threshold) {
  ErrorMetricOptions options;
  options.threshold = threshold;
  return options;
}

ErrorMetricOptions withLimits(double threshold, double smallest, double largest) {
  ErrorMetricOptions options = withThreshold(threshold);
  options.smallest_radius = smallest;
  options.largest_radius = largest;
  return options;
}

/// E = 4 W/m^2, |grad E| = 5 W/m^3, a distance of 3 m: the irradiance changes by its size over 0.8 m.
RecordDerivatives record() { return {{4.0}, Vector2d(3.0, -4.0), {{hessianOf(-7.0, 2.0, 0.4)}}, 3.0}; }

Vector2d halfAxes(std::string_view metric, const ErrorMetricOptions& options, const RecordDerivatives& record) {
  return ErrorMetric(metric, options).region(record).half_axes;
}

Vector2d circle(double radius) { return Vector2d::Constant(radius); }

TEST(ErrorMetric, AreTheFiveOfThePaper) {
  std::vector<std::string> names;
  for (const ErrorMetricDescription& metric : errorMetricDescriptions()) {
    names.emplace_back(metric.name);
    const ErrorMetric made(metric.name, withLimits(0.1, 0.01, 10.0));
    EXPECT_EQ(made.description().name, metric.name);
    EXPECT_GT(made.region(record()).half_axes.minCoeff(), 0.0);
  }
  EXPECT_THAT(names, ElementsAre("split-sphere", "bounded-split-sphere", "radiometric-hessian", "geometric-hessian",
                                 "occlusion-hessian"));
  EXPECT_THAT([] { ErrorMetric("split", withThreshold(0.1)); },
              ThrowsMessage<std::invalid_argument>(
                  "unknown error metric \"split\": must be one of split-sphere, bounded-split-sphere, "
                  "radiometric-hessian, geometric-hessian, occlusion-hessian"));
}

TEST(ErrorMetric, SplitSphereIsAShareOfTheDistanceAlone) {
  RecordDerivatives r;
  r.harmonic_mean_distance = 3.0;
  EXPECT_EQ(halfAxes("split-sphere", withThreshold(0.25), r), circle(0.75));
  EXPECT_EQ(halfAxes("split-sphere", withThreshold(0.25), record()), circle(0.75));
  r.harmonic_mean_distance = kInfinity;
  EXPECT_EQ(halfAxes("split-sphere", withThreshold(0.25), r), circle(kInfinity));
}

TEST(ErrorMetric, BoundedSplitSphereIsClampedToTheGradientThenToTheLimits) {
  EXPECT_EQ(halfAxes("bounded-split-sphere", withLimits(0.25, 0.01, 10.0), record()), circle(0.2));
  RecordDerivatives flat = record();
  flat.tangential_gradient = Vector2d(0.3, 0.4);
  EXPECT_EQ(halfAxes("bounded-split-sphere", withLimits(0.25, 0.01, 10.0), flat), circle(0.75));
  flat.tangential_gradient = Vector2d::Zero();
  EXPECT_EQ(halfAxes("bounded-split-sphere", withLimits(0.25, 0.01, 10.0), flat), circle(0.75));
  EXPECT_EQ(halfAxes("bounded-split-sphere", withLimits(0.25, 0.01, 0.5), flat), circle(0.5));
  EXPECT_EQ(halfAxes("bounded-split-sphere", withLimits(0.25, 1.0, 10.0), flat), circle(1.0));
  // Where there is no light but a gradient, and where nothing is near.
  RecordDerivatives dark = record();
  dark.irradiance = {0.0};
  EXPECT_EQ(halfAxes("bounded-split-sphere", withLimits(0.25, 0.01, 10.0), dark), circle(0.01));
  dark.tangential_gradient = Vector2d::Zero();
  dark.harmonic_mean_distance = kInfinity;
  EXPECT_EQ(halfAxes("bounded-split-sphere", withLimits(0.25, 0.01, 10.0), dark), circle(10.0));
}

TEST(ErrorMetric, HessianMetricsKeepTheirErrorAndAreLimitedLast) {
  for (const char* name : {"radiometric-hessian", "geometric-hessian", "occlusion-hessian"}) {
    const ValidRegion region = ErrorMetric(name, withThreshold(0.05)).region(record());
    const Quadrature error = integrateHalfForm(absoluteHessian(record().tangential_hessian->value), region);
    EXPECT_NEAR(error.value / 4.0, 0.05, 1e-15 + error.error_estimate);
    const Vector2d free = region.half_axes;
    const double between = 0.5 * (free(0) + free(1));
    EXPECT_EQ(halfAxes(name, withLimits(0.05, between, 10.0), record()), Vector2d(between, free(1)));
    EXPECT_EQ(halfAxes(name, withLimits(0.05, 0.0, between), record()), Vector2d(free(0), between));
    EXPECT_EQ(halfAxes(name, withLimits(0.05, 5.0, 5.0), record()), circle(5.0));
  }
}

TEST(ErrorMetric, InFlatlandGiveHalfTheLengthOfAnInterval) {
  const FlatlandRecordDerivatives flat{{4.0}, -5.0, -7.0, 3.0};
  const auto halfLength = [](std::string_view metric, const ErrorMetricOptions& options,
                             const FlatlandRecordDerivatives& record) {
    return ErrorMetric(metric, options).halfLength(record);
  };
  EXPECT_EQ(halfLength("split-sphere", withThreshold(0.25), flat), 0.75);
  EXPECT_EQ(halfLength("bounded-split-sphere", withLimits(0.25, 0.01, 10.0), flat), 0.2);
  EXPECT_EQ(halfLength("bounded-split-sphere", withLimits(0.25, 0.5, 10.0), flat), 0.5);
  for (const char* name : {"radiometric-hessian", "geometric-hessian", "occlusion-hessian"}) {
    // 7 R^3/3 = eps E, 7 R^2/6 = eps E.
    ErrorMetricOptions options = withThreshold(0.05);
    const double total = halfLength(name, options, flat);
    EXPECT_NEAR(7.0 * total * total * total / 3.0, 0.2, 1e-15);
    options.ellipse.measure = ErrorMeasure::kMean;
    const double mean = halfLength(name, options, flat);
    EXPECT_NEAR(7.0 * mean * mean / 6.0, 0.2, 1e-15);
    EXPECT_EQ(halfLength(name, withLimits(0.05, 0.0, 0.1), flat), 0.1);
    EXPECT_THAT(
        [&] {
          halfLength(name, options, {{4.0}, {}, {}, 3.0});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr("the record has no tangential Hessian")));
  }
  EXPECT_THAT(
      [&] {
        halfLength("split-sphere", withThreshold(0.1), {{4.0}, -5.0, -7.0, {}});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("the record has no harmonic mean distance")));
}

TEST(ErrorMetric, OfRelativeErrorDoNotDependOnTheUnitOfRadiance) {
  RecordDerivatives brighter = record();
  brighter.irradiance.value *= 1024.0;
  *brighter.tangential_gradient *= 1024.0;
  brighter.tangential_hessian->value *= 1024.0;
  for (const ErrorMetricDescription& metric : errorMetricDescriptions()) {
    ErrorMetricOptions options = withLimits(0.05, 1e-3, 1e3);
    const Vector2d before = halfAxes(metric.name, options, record());
    EXPECT_LE((halfAxes(metric.name, options, brighter) - before).cwiseAbs().maxCoeff(), 1e-15 * before(1))
        << metric.name;
    options.ellipse.scale = ErrorScale::kAbsolute;
    if (metric.takes_hessian) {
      EXPECT_LT(halfAxes(metric.name, options, brighter)(0), 0.2 * before(0));
    }
  }
}

TEST(ErrorMetric, OfAHessianOfZeroIsInfiniteOrTheLargestRadius) {
  for (const double irradiance : {0.0, 4.0}) {
    RecordDerivatives flat = record();
    flat.irradiance = {irradiance};
    flat.tangential_hessian = {{Matrix2d::Zero()}};
    EXPECT_EQ(halfAxes("occlusion-hessian", withThreshold(0.05), flat), circle(kInfinity));
    EXPECT_EQ(halfAxes("occlusion-hessian", withLimits(0.05, 0.0, 2.0), flat), circle(2.0));
  }
}

TEST(ErrorMetric, OptionsOutOfRangeAreRefused) {
  for (const double threshold : {0.0, -0.1, kNan, kInfinity}) {
    for (const ErrorMetricDescription& metric : errorMetricDescriptions()) {
      EXPECT_THAT(
          [&] { ErrorMetric(metric.name, withLimits(threshold, 0.1, 1.0)); },
          ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(std::string(metric.name)), HasSubstr("the threshold is"),
                                                     HasSubstr("must be positive and finite"))));
    }
  }
  for (const std::pair<double, double>& limits :
       {std::pair(-1.0, 1.0), std::pair(2.0, 1.0), std::pair(0.0, 0.0), std::pair(kNan, 1.0), std::pair(0.0, kNan),
        std::pair(kInfinity, kInfinity)}) {
    EXPECT_THAT([&] { ErrorMetric("occlusion-hessian", withLimits(0.1, limits.first, limits.second)); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("the limits of the radius are")));
  }
  for (const std::pair<double, double>& limits : {std::pair(0.0, 1.0), std::pair(0.1, kInfinity)}) {
    EXPECT_THAT([&] { ErrorMetric("bounded-split-sphere", withLimits(0.1, limits.first, limits.second)); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("must be positive and finite")));
  }
  ErrorMetricOptions thin = withThreshold(0.1);
  thin.ellipse.largest_aspect = 0.5;
  EXPECT_THAT(
      [&] { ErrorMetric("occlusion-hessian", thin); },
      ThrowsMessage<std::invalid_argument>("the largest aspect of an ellipse is 0.5, must be finite and at least 1"));
}

void expectRefused(std::string_view metric, const RecordDerivatives& record, const std::string& message) {
  EXPECT_THAT([&] { halfAxes(metric, withLimits(0.1, 0.01, 10.0), record); },
              ThrowsMessage<std::invalid_argument>(HasSubstr(message)))
      << metric;
}

TEST(ErrorMetric, RecordsThatLackOrBreakSomethingAreRefused) {
  RecordDerivatives bare;
  bare.irradiance = {4.0};
  expectRefused("split-sphere", bare, "error metric split-sphere: the record has no harmonic mean distance");
  expectRefused("occlusion-hessian", bare, "error metric occlusion-hessian: the record has no tangential Hessian");
  bare.harmonic_mean_distance = 1.0;
  expectRefused("bounded-split-sphere", bare, "the record has no translational gradient");
  for (const double distance : {0.0, -1.0, kNan}) {
    bare.harmonic_mean_distance = distance;
    expectRefused("split-sphere", bare, "the harmonic mean distance of a record is");
  }
  for (const double irradiance : {-1.0, kNan, kInfinity}) {
    RecordDerivatives broken = record();
    broken.irradiance = {irradiance};
    for (const ErrorMetricDescription& metric : errorMetricDescriptions()) {
      expectRefused(metric.name, broken, "the irradiance of a record is");
    }
  }
  RecordDerivatives broken = record();
  broken.tangential_gradient = Vector2d(kNan, 0.0);
  expectRefused("bounded-split-sphere", broken, "the tangential gradient of a record is (nan, 0), must be finite");
  broken.tangential_hessian->value(0, 1) = kInfinity;
  expectRefused("geometric-hessian", broken, "the tangential Hessian of a record has the rows");
  RecordDerivatives dark = record();
  dark.irradiance = {0.0};
  expectRefused("occlusion-hessian", dark, "the irradiance of a record is 0, must be positive for a relative error");
}

TEST(ErrorMetric, ARadiusTooSmallForDoubleIsAnErrorAndNotZero) {
  RecordDerivatives near = record();
  near.harmonic_mean_distance = 1e-200;
  EXPECT_THAT([&] { halfAxes("split-sphere", withThreshold(1e-200), near); },
              ThrowsMessage<std::range_error>(HasSubstr("too small for double")));
}

}  // namespace
}  // namespace irradiff::error_metric_test
