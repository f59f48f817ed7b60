#include "experiments/cache_3d/metric_records.h"

#include "derivatives/error_metric/error_metric.h"
#include "experiments/cache_3d/knowledge_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace irradiff {
namespace {

using testing::HasSubstr;

/// On a slanted plane. Hessians of all three kinds and both shares differ.
RecordKnowledge knowledge() {
  RecordKnowledge known;
  known.irradiance = 2.0;
  known.gradient = {0.3, -0.2, 0.1};
  known.rotational_gradient = {0.5, 0.6, -0.7};
  known.harmonic_mean_distance = 1.5;
  double size = 1.0;
  for (MetricHessians& hessians : known.hessians) {
    hessians.irradiance = 2.0;
    for (Eigen::Matrix2d* hessian : {&hessians.radiometric, &hessians.geometric, &hessians.occlusion}) {
      *hessian << 3.0 * size, 0.5, 0.5, 1.0;
      size *= 2.0;
    }
  }
  return known;
}

/// The error of the Hessian diag(h, h).
ErrorProfile roundProfile(double h) {
  ErrorProfile profile{{0.5}, {}};
  for (int k = 0; k < 16; ++k) profile.errors.push_back(static_cast<float>(h * 0.125));
  return profile;
}

std::shared_ptr<FieldKnowledge> field(const RecordKnowledge& known) {
  auto result = std::make_shared<FieldKnowledge>();
  result->receivers = {{{1.0, 2.0, 3.0}, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0}};
  result->pixel_sizes = {0.01};
  result->record = [known](std::size_t) { return known; };
  result->reprojection = [](std::size_t) { return roundProfile(1.0); };
  result->oracle = [](std::size_t) { return roundProfile(16.0); };
  result->least_irradiance = 0.1;
  return result;
}

MetricChoice choiceOf(const std::string& metric, double threshold) {
  MetricChoice choice;
  choice.metric = metric;
  choice.threshold = threshold;
  return choice;
}

TEST(MetricRecords, HaveWhatIsKnownAndTheMetricsRegion) {
  const RecordKnowledge known = knowledge();
  const auto all = field(known);
  for (const ErrorMetricDescription& description : errorMetricDescriptions()) {
    for (std::size_t share = 0; share < kRadianceShares.size(); ++share) {
      MetricChoice choice = choiceOf(std::string(description.name), 0.05);
      choice.radiance_share = kRadianceShares[share];
      choice.largest_pixels = 500.0;
      const CacheRecord record = recordMaker(all, choice)(0);
      EXPECT_EQ(record.irradiance, known.irradiance);
      EXPECT_EQ(record.gradient, known.gradient);
      EXPECT_EQ(record.rotational_gradient, known.rotational_gradient);
      EXPECT_EQ(record.hessian, Eigen::Matrix3d::Zero());

      const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(record.receiver.normal);
      RecordDerivatives derivatives{{known.irradiance}, frame.transpose() * known.gradient, {}, 1.5};
      const MetricHessians& hessians = known.hessians[share];
      derivatives.tangential_hessian = {description.name == "radiometric-hessian" ? hessians.radiometric
                                        : description.name == "geometric-hessian" ? hessians.geometric
                                                                                  : hessians.occlusion};
      const ValidRegion region = ErrorMetric(description.name, {0.05, {}, 0.01, 5.0}).region(derivatives);
      EXPECT_EQ(record.half_axes, region.half_axes) << description.name;
      EXPECT_EQ(record.first_axis, frame * region.axes.col(0)) << description.name;
      EXPECT_EQ(record.second_axis, frame * region.axes.col(1)) << description.name;
    }
  }
}

TEST(MetricRecords, SharesDiffer) {
  MetricChoice choice = choiceOf("occlusion-hessian", 0.05);
  const CacheRecord with = recordMaker(field(knowledge()), choice)(0);
  choice.radiance_share = 0.0;
  const CacheRecord without = recordMaker(field(knowledge()), choice)(0);
  EXPECT_LT(with.half_axes(0), without.half_axes(0));
}

TEST(MetricRecords, OfProfilesAreTheirLargestEllipses) {
  // pi/4 |h| R^4 at eps E for a circle: 16 times the error gives half the radius.
  const auto radius = [](double h, double limit) { return std::pow(4.0 * limit / (std::numbers::pi * h), 0.25); };
  const double eps = 1e-3;
  const CacheRecord predicted = recordMaker(field(knowledge()), choiceOf("reprojection", eps))(0);
  const CacheRecord best = recordMaker(field(knowledge()), choiceOf("oracle", eps))(0);
  // Search: 2^-10; floats.
  EXPECT_NEAR(predicted.half_axes(0), radius(1.0, eps * 2.0), 2e-3 * predicted.half_axes(0));
  EXPECT_NEAR(best.half_axes(0), radius(16.0, eps * 2.0), 2e-3 * best.half_axes(0));

  // In the dark errors are a share of the least irradiance.
  RecordKnowledge dark = knowledge();
  dark.irradiance = 0.0;
  const CacheRecord black = recordMaker(field(dark), choiceOf("oracle", eps))(0);
  EXPECT_NEAR(black.half_axes(0), radius(16.0, eps * 0.1), 2e-3 * black.half_axes(0));
  // What a black record predicts is a share of the mean, 100 times as much.
  const CacheRecord feared = recordMaker(field(dark), choiceOf("reprojection", eps))(0);
  EXPECT_NEAR(feared.half_axes(0), radius(1.0, eps * 10.0), 2e-3 * feared.half_axes(0));
}

TEST(MetricRecords, TrueErrorIsTheOracles) {
  const auto all = field(knowledge());
  CacheRecord record = recordMaker(all, choiceOf("occlusion-hessian", 0.05))(0);
  record.half_axes = {0.4, 0.4};
  // pi/4 h R^4.
  EXPECT_NEAR(trueError(all)(0, record), std::numbers::pi / 4.0 * 16.0 * std::pow(0.4, 4), 1e-6);
}

TEST(MetricRecords, NameWhatIsWrong) {
  const auto messageOf = [](const MetricChoice& choice) -> std::string {
    try {
      recordMaker(field(knowledge()), choice);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  EXPECT_THAT(messageOf(choiceOf("orakel", 1.0)), HasSubstr("\"orakel\": must be one of split-sphere, "));
  EXPECT_THAT(messageOf(choiceOf("second-order", 1.0)), HasSubstr("must be one of"));
  EXPECT_THAT(messageOf(choiceOf("oracle", 0.0)), HasSubstr("the threshold is 0"));
  EXPECT_THAT(messageOf(choiceOf("occlusion-hessian", -1.0)), HasSubstr("-1"));
  EXPECT_THAT(messageOf(choiceOf("bounded-split-sphere", 1.0)), HasSubstr("finite"));
  MetricChoice share = choiceOf("occlusion-hessian", 1.0);
  share.radiance_share = 0.02;
  EXPECT_THAT(messageOf(share), HasSubstr("0.02"));
  MetricChoice limits = choiceOf("reprojection", 1.0);
  limits.smallest_pixels = 3.0;
  limits.largest_pixels = 2.0;
  EXPECT_THAT(messageOf(limits), HasSubstr("3 and 2 pixels"));
}

TEST(MetricRecords, KnowledgeComesBackFromNumbers) {
  const RecordKnowledge known = knowledge();
  std::vector<double> numbers;
  appendNumbers(known, numbers);
  ASSERT_EQ(numbers.size(), kKnowledgeNumbers);
  const RecordKnowledge again = knowledgeOf(std::span<const double, kKnowledgeNumbers>(numbers));
  std::vector<double> numbers_again;
  appendNumbers(again, numbers_again);
  EXPECT_EQ(numbers_again, numbers);
  EXPECT_EQ(again.gradient, known.gradient);
  EXPECT_EQ(again.hessians[1].occlusion, known.hessians[1].occlusion);
  EXPECT_NE(again.hessians[0].occlusion, known.hessians[1].occlusion);
}

}  // namespace
}  // namespace irradiff
