// Records that no light reaches: what they know says nothing against any region, so that a rule has to limit them.

#include "experiments/cache_3d/metric_records.h"
#include "experiments/curves/error_curves.h"
#include "tests/curves/study_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

constexpr double kPixel = 0.01;
constexpr double kLimit = 20.0;

/// Receiver 0 is black and has Hessians and predicted errors of zero, receiver 1 is the same with light.
RecordMaker makerFor(const std::string& metric, double black_pixels, double largest_pixels) {
  auto field = std::make_shared<FieldKnowledge>();
  field->receivers.resize(2);
  for (Receiver& receiver : field->receivers) receiver = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
  field->pixel_sizes = {kPixel, kPixel};
  field->least_irradiance = 0.01;
  field->record = [](std::size_t i) {
    RecordKnowledge known;
    known.irradiance = static_cast<double>(i);
    known.harmonic_mean_distance = std::numeric_limits<double>::infinity();
    for (MetricHessians& hessians : known.hessians) hessians.irradiance = 1.0;
    return known;
  };
  const auto nothing = [](std::size_t) {
    ErrorProfile profile;
    profile.distances = {0.1, 1.0};
    profile.errors.assign(2 * 8, 0.0);
    return profile;
  };
  field->reprojection = nothing;
  field->oracle = nothing;
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = 1e-3;
  choice.black_pixels = black_pixels;
  choice.largest_pixels = largest_pixels;
  return recordMaker(field, choice);
}

const double kNoLimit = std::numeric_limits<double>::infinity();

TEST(BlackRecords, KeepTheirLimitAndOthersDoNot) {
  for (const char* metric :
       {"split-sphere", "radiometric-hessian", "geometric-hessian", "occlusion-hessian", "reprojection"}) {
    const RecordMaker limited = makerFor(metric, kLimit, kNoLimit);
    EXPECT_DOUBLE_EQ(limited(0).half_axes.maxCoeff(), kLimit * kPixel) << metric;
    EXPECT_DOUBLE_EQ(limited(0).half_axes.minCoeff(), kLimit * kPixel) << metric;
    EXPECT_TRUE(std::isinf(limited(1).half_axes.minCoeff())) << metric << ": there is light";
    // The bad twin: without the rule nothing limits the black record.
    EXPECT_TRUE(std::isinf(makerFor(metric, kNoLimit, kNoLimit)(0).half_axes.minCoeff())) << metric;
    // What is asked of all records is asked of black ones too.
    EXPECT_DOUBLE_EQ(makerFor(metric, kLimit, 0.5 * kLimit)(0).half_axes.maxCoeff(), 0.5 * kLimit * kPixel) << metric;
    EXPECT_DOUBLE_EQ(makerFor(metric, 0.1, kNoLimit)(0).half_axes.maxCoeff(), kPixel) << metric << ": a pixel is least";
  }
}

TEST(BlackRecords, OfTheOracleKnowWhatIsAround) {
  EXPECT_TRUE(std::isinf(makerFor("oracle", kLimit, kNoLimit)(0).half_axes.minCoeff()));
}

TEST(BlackRecords, RefuseALimitOfNothing) {
  for (const double limit : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(makerFor("occlusion-hessian", limit, kNoLimit), std::invalid_argument) << limit;
  }
}

TEST(BlackRecords, HaveATwelfthOfTheImageByDefault) {
  const RecordField field = curves_test::publishedField(48);
  for (const std::string& metric : field.metrics) {
    const MetricChoice choice = defaultChoice(field, metric);
    EXPECT_DOUBLE_EQ(choice.black_pixels, 4.0) << metric;
    EXPECT_EQ(std::isinf(choice.largest_pixels), metric != "bounded-split-sphere") << metric;
  }
}

}  // namespace
}  // namespace irradiff
