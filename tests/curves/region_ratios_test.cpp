// Regions beside the oracle's.

#include "experiments/curves/region_ratios.h"

#include "experiments/curves/study_text.h"
#include "tests/curves/study_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

using curves_test::studyField;

struct Measured {
  RecordField field = studyField(32);
  ErrorCurves curves;
  Measured() {
    const std::vector<RecordField> fields{field};
    curves = errorCurves(fields, field.metrics, std::vector<std::size_t>{100}, {}, 2, nullptr);
  }
};

const Measured& measured() {
  static const Measured all;
  return all;
}

// The oracle of this field is the occlusion Hessian with another threshold: at the same count both have the same
// regions, as near as 2 % of the count allow.
TEST(RegionRatios, AreOneForTheSameRegions) {
  const auto all = regionRatios(measured().field, measured().curves, 100, 1);
  ASSERT_EQ(all.size(), 3U);
  const RatioQuantiles oracle = quantilesOf(all[2].radii);
  EXPECT_EQ(oracle.quantiles[0], 1.0);
  EXPECT_EQ(oracle.quantiles[4], 1.0);
  // Counts within 2 % each: radii within about 2 %.
  const RatioQuantiles hessian = quantilesOf(all[1].radii);
  EXPECT_NEAR(hessian.quantiles[0], 1.0, 0.05);
  EXPECT_NEAR(hessian.quantiles[4], 1.0, 0.05);
  // Circles of one size: too large where the light is not smooth and too small elsewhere.
  const RatioQuantiles circles = quantilesOf(all[0].radii);
  EXPECT_LT(circles.quantiles[0], 0.9);
  EXPECT_GT(circles.quantiles[4], 1.1);
  EXPECT_TRUE(all[0].kept.empty()) << "a split sphere promises nothing";
  EXPECT_EQ(all[1].kept.size(), 32U * 32U);
}

TEST(RegionRatios, DoNotDependOnThreads) {
  const auto one = regionRatios(measured().field, measured().curves, 100, 1);
  const auto three = regionRatios(measured().field, measured().curves, 100, 3);
  for (std::size_t m = 0; m < one.size(); ++m) {
    EXPECT_EQ(one[m].radii, three[m].radii);
    EXPECT_EQ(one[m].errors, three[m].errors);
  }
}

// The error that a Hessian predicts is the true one where the light is smooth on the scale of the region: the median of
// what is kept is near 1, with half the threshold it is twice that.
TEST(RegionRatios, TellWhetherAPromiseIsKept) {
  const auto all = regionRatios(measured().field, measured().curves, 100, 2);
  const double kept = quantilesOf(all[1].kept).quantiles[2];
  EXPECT_GT(kept, 0.5);
  EXPECT_LT(kept, 1.5);
  // errors and kept are of one true error: their ratio is that of what is allowed.
  for (std::size_t i = 0; i < all[1].kept.size(); ++i) {
    EXPECT_NEAR(all[1].errors[i] / all[1].kept[i], all[1].threshold / all[1].oracle_threshold, 1e-12);
  }
}

TEST(RegionRatios, AreNoneWithoutAnOracle) {
  ErrorCurves curves = measured().curves;
  std::erase_if(curves.points, [](const CurvePoint& point) { return point.metric == "oracle"; });
  EXPECT_TRUE(regionRatios(measured().field, curves, 100, 1).empty());
  EXPECT_TRUE(regionRatios(measured().field, measured().curves, 101, 1).empty());
}

TEST(RatioQuantiles, LeaveOutWhatIsNoNumber) {
  std::vector<double> ratios;
  for (int i = 1; i <= 100; ++i) ratios.push_back(0.02 * i);
  ratios.push_back(std::numeric_limits<double>::quiet_NaN());
  const RatioQuantiles found = quantilesOf(ratios);
  EXPECT_EQ(found.values, 100U);
  EXPECT_DOUBLE_EQ(found.quantiles[0], 0.1);
  EXPECT_DOUBLE_EQ(found.quantiles[2], 1.0);
  EXPECT_DOUBLE_EQ(found.quantiles[4], 1.9);
  EXPECT_DOUBLE_EQ(found.share_above_1, 0.5);
  EXPECT_EQ(quantilesOf({}).values, 0U);
  EXPECT_TRUE(std::isnan(quantilesOf({}).quantiles[0]));
}

TEST(AllowedError, IsAnIntegralOrAMean) {
  RecordField field = studyField(8);
  MetricChoice choice;
  choice.threshold = 0.1;
  const Eigen::Vector2d half_axes(0.2, 0.3);
  EXPECT_DOUBLE_EQ(allowedError(field, choice, 5.0, half_axes), 0.5);
  choice.ellipse.scale = ErrorScale::kAbsolute;
  EXPECT_DOUBLE_EQ(allowedError(field, choice, 5.0, half_axes), 0.1);
  choice.ellipse.measure = ErrorMeasure::kMean;
  EXPECT_DOUBLE_EQ(allowedError(field, choice, 5.0, half_axes), 0.1 * std::numbers::pi * 0.06);
  field.height = 1;
  EXPECT_DOUBLE_EQ(allowedError(field, choice, 5.0, half_axes), 0.1 * 0.4);
}

TEST(Character, FollowsTheNumbers) {
  RegionRatios ratios;
  ratios.radii.assign(100, 1.0);
  ratios.errors.assign(100, 1.0);
  EXPECT_EQ(characterOf(ratios), "safe");
  std::fill_n(ratios.errors.begin(), 4, 100.0);
  EXPECT_EQ(characterOf(ratios), "safe") << "one in twenty-five is not one in twenty";
  std::fill_n(ratios.errors.begin(), 8, 100.0);
  EXPECT_EQ(characterOf(ratios), "reckless");
  ratios.radii.assign(100, 0.5);
  EXPECT_EQ(characterOf(ratios), "reckless and timid");
  ratios.errors.assign(100, 1.0);
  EXPECT_EQ(characterOf(ratios), "timid");
}

}  // namespace
}  // namespace irradiff
