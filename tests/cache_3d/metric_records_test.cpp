#include "experiments/cache_3d/metric_records.h"

#include "derivatives/error_metric/error_metric.h"
#include "experiments/cache_3d/knowledge_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

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

TEST(MetricRecords, HaveKnownGeometryWhereItIsOffered) {
  RecordKnowledge known = knowledge();
  known.known_geometry = {2.5, {0.1, 0.3, -0.35}, {0.7, -0.1, 0.2}};
  const auto all = field(known);
  MetricChoice choice = choiceOf("occlusion-hessian", 0.05);
  choice.knows_geometry = true;
  EXPECT_THAT([&] { recordMaker(all, choice); }, testing::ThrowsMessage<std::invalid_argument>(
                                                     HasSubstr("occlusion-hessian: records with known geometry")));
  all->offers_known_geometry = true;
  for (const char* metric : {"occlusion-hessian", "reprojection", "oracle"}) {
    choice.metric = metric;
    const CacheRecord record = recordMaker(all, choice)(0);
    EXPECT_EQ(record.irradiance, 2.5);
    EXPECT_EQ(record.gradient, known.known_geometry.gradient);
    EXPECT_EQ(record.rotational_gradient, known.known_geometry.rotational_gradient);
    // Bad twin: not asked for.
    MetricChoice without = choice;
    without.knows_geometry = false;
    EXPECT_EQ(recordMaker(all, without)(0).irradiance, known.irradiance);
    EXPECT_EQ(recordMaker(all, without)(0).gradient, known.gradient);
  }
}

/// A field that predicts the remainder of a quadratic, and beyond it a cubic.
std::shared_ptr<FieldKnowledge> predictingField(const RecordKnowledge& known, const Eigen::Matrix2d& hessian,
                                                double cubic) {
  auto result = field(known);
  result->predicted = [hessian, cubic](std::size_t) -> RemainderAround {
    return [hessian, cubic](const Eigen::Vector2d& step) -> std::optional<double> {
      return 0.5 * step.dot(hessian * step) + cubic * step.squaredNorm() * step.norm();
    };
  };
  result->profile_distances = [](std::size_t) {
    std::vector<double> distances;
    for (int m = 0; m < 16; ++m) distances.push_back(0.8 * std::pow(0.8, 15 - m));
    return distances;
  };
  return result;
}

TEST(MetricRecords, TrueErrorOfSecondOrderIsThatOfTheQuadratic) {
  Eigen::Matrix2d hessian;
  hessian << 2.0, 0.3, 0.3, 1.0;
  const auto all = field(knowledge());
  const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(all->receivers[0].normal);
  // Truth: this quadratic and 0.4 |d|^2 on top.
  all->truth = [&](std::size_t) -> IrradianceAround {
    return [&](const Eigen::Vector2d& step) -> std::optional<double> {
      return 2.0 + step.dot(frame.transpose() * knowledge().gradient) + 0.5 * step.dot(hessian * step) +
             0.4 * step.squaredNorm();
    };
  };
  all->true_distances = [](std::size_t) { return std::vector<double>{0.2, 0.4}; };
  CacheRecord record = recordMaker(all, choiceOf("occlusion-hessian", 0.05))(0);
  record.half_axes = {0.4, 0.4};
  record.hessian = frame * hessian * frame.transpose();
  // The integral of 0.4 r^2 over a disc is pi 0.2 R^4; a chord between 0.2 and 0.4 adds to it.
  const double exact = std::numbers::pi * 0.2 * std::pow(0.4, 4);
  EXPECT_NEAR(trueError(all)(0, record), exact, 0.15 * exact);
  record.hessian.setZero();
  EXPECT_GT(trueError(all)(0, record), 1.5 * exact) << "bad twin: without the Hessian";
}

TEST(MetricRecords, OfSecondOrderHaveTheHessianThatIsPredicted) {
  RecordKnowledge known = knowledge();
  const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(field(known)->receivers[0].normal);
  known.gradient = frame * Eigen::Vector2d(0.3, -0.2);
  Eigen::Matrix2d hessian;
  hessian << 2.0, -0.7, -0.7, -1.5;
  MetricChoice choice = choiceOf("second-order", 1e-3);
  choice.largest_pixels = 100.0;
  const CacheRecord record = recordMaker(predictingField(known, hessian, 0.0), choice)(0);
  // Whatever Hessian the samples had, the fit of a quadratic is this quadratic.
  EXPECT_LT((record.hessian - frame * hessian * frame.transpose()).norm(), 1e-9);
  EXPECT_LT((record.gradient - known.gradient).norm(), 1e-9);
  EXPECT_EQ(record.irradiance, known.irradiance);
  EXPECT_GT((record.hessian - frame * known.hessians[0].occlusion * frame.transpose()).norm(), 1.0) << "bad twin";
  EXPECT_EQ(recordMaker(predictingField(known, hessian, 0.0), choiceOf("reprojection", 1e-3))(0).hessian,
            Eigen::Matrix3d::Zero());

  // The region is that of the samples' Taylor polynomial: where its Hessian is right, up to the largest one.
  RecordKnowledge right = known;
  right.hessians[0].occlusion = hessian;
  EXPECT_NEAR(recordMaker(predictingField(right, hessian, 0.0), choice)(0).half_axes(0), 1.0, 1e-12);
  EXPECT_LT(record.half_axes(0), 0.5);
  // With a cubic: 2 pi c R^5/5 at eps E for a circle.
  choice.ellipse.largest_aspect = 1.0;
  const double radius = std::pow(5.0 * 1e-3 * 2.0 / (2.0 * std::numbers::pi * 0.5), 0.2);
  const CacheRecord cubic = recordMaker(predictingField(right, hessian, 0.5), choice)(0);
  EXPECT_NEAR(cubic.half_axes(0), radius, 0.05 * radius);  // Chords between distances.
  // What is not seen makes it smaller, and a quadratic's fit has more curvature with a cubic on top.
  auto unseen = predictingField(right, hessian, 0.5);
  unseen->add_unseen = [](std::size_t, ErrorProfile& errors) {
    for (float& error : errors.errors) error += 0.02f;
  };
  EXPECT_LT(recordMaker(unseen, choice)(0).half_axes(0), 0.8 * radius);
  EXPECT_GT((frame.transpose() * cubic.hessian * frame).trace(), hessian.trace() + 0.1);

  // Without light there is nothing to extrapolate.
  known.irradiance = 0.0;
  EXPECT_EQ(recordMaker(predictingField(known, hessian, 0.0), choice)(0).hessian, Eigen::Matrix3d::Zero());
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
