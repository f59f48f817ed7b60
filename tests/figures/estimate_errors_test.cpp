#include "experiments/figures/estimate_errors.h"

#include "tests/figures/small_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Gradient (1, -2, 0) and Hessian diag(3, 1) everywhere, as plainMap has them.
EstimateMap exactEstimate(std::size_t count) {
  EstimateValues values{};
  values[kEstimateGradientX] = 1.0;
  values[kEstimateGradientY] = -2.0;
  values[kEstimateGradientZ] = kMissing;
  values[kEstimateHessianXX] = 3.0;
  values[kEstimateHessianXY] = 0.0;
  values[kEstimateHessianYY] = 1.0;
  values[kEstimateLambda1] = 3.0;
  values[kEstimateLambda2] = 1.0;
  values[kEstimateLambda3] = -4.0;
  return {"exact", std::vector<EstimateValues>(count, values)};
}

std::vector<double>& channelOf(DerivativeMap& map, const std::string& name) {
  return std::ranges::find(map.channels, name, &MapChannel::name)->values;
}

TEST(EstimateErrors, AreTheLargestDifferenceOverTheLargestComponent) {
  const DerivativeMap truth = plainMap(2, 2);
  EstimateMap estimate = exactEstimate(4);
  for (const Compared compared : kAllCompared) {
    EXPECT_EQ(relativeErrors(estimate, truth, compared), std::vector<double>(4, 0.0)) << quantityOf(compared).name;
  }
  estimate.values[1][kEstimateGradientX] += 0.5;
  estimate.values[1][kEstimateGradientY] -= 0.25;
  estimate.values[2][kEstimateGradientY] += 4.0;
  estimate.values[3][kEstimateHessianXY] = -1.5;
  estimate.values[0][kEstimateLambda2] = 3.0;
  EXPECT_EQ(relativeErrors(estimate, truth, Compared::kGradient), (std::vector<double>{0.0, 0.25, 2.0, 0.0}));
  EXPECT_EQ(relativeErrors(estimate, truth, Compared::kHessian), (std::vector<double>{0.0, 0.0, 0.0, 0.5}));
  EXPECT_EQ(relativeErrors(estimate, truth, Compared::kEigenvalues), (std::vector<double>{0.5, 0.0, 0.0, 0.0}));
  EXPECT_EQ(relativeError(estimate.values[2], truth, 2, Compared::kGradient), 2.0);
}

TEST(EstimateErrors, LeaveOutWhatCannotBeComparedAndSayHowMuch) {
  DerivativeMap truth = plainMap(3, 2);
  EstimateMap estimate = exactEstimate(6);
  channelOf(truth, "gradient.y")[0] = kMissing;
  // 0 to within the bound of 2e-14 that small maps have.
  channelOf(truth, "gradient.x")[1] = 1e-14;
  channelOf(truth, "gradient.y")[1] = -2e-14;
  estimate.values[2][kEstimateGradientX] = kMissing;
  estimate.values[3][kEstimateGradientX] += 1.0;
  const ErrorSummary summary = summarise(estimate, truth, Compared::kGradient);
  EXPECT_EQ(summary.no_truth, 1U);
  EXPECT_EQ(summary.zero_truth, 1U);
  EXPECT_EQ(summary.no_estimate, 1U);
  EXPECT_EQ(summary.compared, 3U);
  EXPECT_EQ(summary.median, 0.0);
  EXPECT_EQ(summary.percentile99, 0.5);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(1.0 / (3 * 4.0)));
  const std::vector<double> errors = relativeErrors(estimate, truth, Compared::kGradient);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(std::isnan(errors[i]), i < 3) << i;
}

TEST(EstimateErrors, OfNothingAreNaN) {
  DerivativeMap truth = plainMap(2, 1);
  channelOf(truth, "lambda3").assign(2, kMissing);
  const ErrorSummary summary = summarise(exactEstimate(2), truth, Compared::kEigenvalues);
  EXPECT_EQ(summary.no_truth, 2U);
  EXPECT_TRUE(std::isnan(summary.median) && std::isnan(summary.percentile99) && std::isnan(summary.rms));
  EXPECT_EQ(errorNumber(summary.median), "none");
  EXPECT_EQ(errorNumber(0.03456), "0.035");
}

TEST(EstimateErrors, PercentilesAreValuesThatAreThere) {
  std::vector<double> numbers(200);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  EXPECT_EQ(percentile(numbers, 0.5), 100.0);
  EXPECT_EQ(percentile(numbers, 0.99), 198.0);
  EXPECT_EQ(percentile(numbers, 0.0), 1.0);
  EXPECT_EQ(percentile(numbers, 1.0), 200.0);
  EXPECT_EQ(percentile({5.0}, 0.05), 5.0);
}

TEST(EstimateErrors, SayWhoKnowsWhat) {
  EstimateMap estimate = exactEstimate(2);
  EXPECT_TRUE(knows(estimate, Compared::kHessian));
  for (EstimateValues& values : estimate.values) values[kEstimateHessianXX] = kMissing;
  EXPECT_FALSE(knows(estimate, Compared::kHessian));
  EXPECT_TRUE(knows(estimate, Compared::kGradient));
}

}  // namespace
}  // namespace irradiff
