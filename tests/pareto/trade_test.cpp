// What is measured of methods, rules and estimators, but for the times themselves.

#include "experiments/pareto/estimator_trade.h"
#include "experiments/pareto/family_inputs.h"
#include "experiments/pareto/polygon_trade.h"
#include "experiments/pareto/rule_regret.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 7;

const MethodTrade& methodOf(const FamilyTrade& family, const std::string& name) {
  for (const MethodTrade& method : family.methods) {
    if (method.method == name) return method;
  }
  throw std::out_of_range(name);
}

TEST(ErrorStatistics, AreOrderStatistics) {
  std::vector<double> errors;
  for (int i = 200; i > 0; --i) errors.push_back(i);
  const ErrorStatistics statistics = statisticsOf(errors);
  EXPECT_EQ(statistics.median, 100.0);
  EXPECT_EQ(statistics.percentile99, 198.0);
  EXPECT_EQ(statistics.peak, 200.0);
  EXPECT_EQ(statisticsOf({5.0}).median, 5.0);
}

TEST(RelativeErrors, AreOfEachQuantityAndTheLargest) {
  OracleValue truth;
  truth.form_factor = 2;
  truth.gradient = MultiprecisionVector(4, 0, -8);
  truth.hessian(0, 0) = -16;
  FormFactor<long double> value{2.0L, {4.0L, 0.0L, -8.0L}, Matrix3<long double>::Zero()};
  value.hessian(0, 0) = -16.0L;
  EXPECT_EQ(relativeErrors(value, truth), (std::array<double, 4>{0, 0, 0, 0}));
  value.gradient(1) = 1.0L;
  EXPECT_EQ(relativeErrors(value, truth), (std::array<double, 4>{0, 0.125, 0, 0.125}));
  value.hessian(2, 1) = std::numeric_limits<long double>::quiet_NaN();
  EXPECT_EQ(relativeErrors(value, truth)[kLargestError], std::numeric_limits<double>::infinity());
  truth.form_factor = 0;
  EXPECT_TRUE(std::isnan(relativeErrors(value, truth)[0]));
}

TEST(PolygonTrade, HasEveryMethodOnTheSameInputs) {
  const FamilyTrade family = tradeOf(familyInputs(inputFamily("well-conditioned"), 12, kSeed), 1);
  EXPECT_EQ(family.inputs, 12U);
  ASSERT_EQ(family.methods.size(), polygonMethods().size());
  EXPECT_EQ(family.methods[0].method, "appendix, acos, double");
  EXPECT_EQ(family.methods[0].ratio.median, 1.0);
  for (const MethodTrade& method : family.methods) {
    EXPECT_GT(method.nanoseconds.low, 0.0) << method.method;
    EXPECT_EQ(method.compared, 12U) << method.method;
  }
  EXPECT_LT(methodOf(family, "evaluatePolygon, double").errors[kLargestError].peak, 2e-14);
  EXPECT_LT(methodOf(family, "rung of ball alone").errors[kLargestError].peak, 1e-15);
  EXPECT_LE(methodOf(family, "evaluatePolygon to 1e-06").errors[kLargestError].peak, 1e-6);
  EXPECT_GT(methodOf(family, "appendix, acos, float").errors[kLargestError].median, 1e-8);
}

TEST(PolygonTrade, ComparesFormulasWithoutAHorizonAboveItAlone) {
  const FamilyInputs inputs = familyInputs(inputFamily("horizon corner"), 6, kSeed);
  const FamilyTrade family = tradeOf(inputs, 1);
  EXPECT_EQ(methodOf(family, "appendix, acos, double").compared, 0U);
  EXPECT_EQ(methodOf(family, "evaluatePolygon, double").compared, 6U);
}

TEST(RuleRegret, CountsWhatIsGuaranteedAndFindsPromisesKept) {
  const std::vector<RuleRegret> regrets = regretsOf(familyInputs(inputFamily("generic"), 10, kSeed), 1);
  ASSERT_EQ(regrets.size(), kChoiceTolerances.size());
  for (std::size_t i = 0; i < regrets.size(); ++i) {
    EXPECT_EQ(regrets[i].tolerance, kChoiceTolerances[i]);
    EXPECT_EQ(regrets[i].broken, 0U);
    EXPECT_EQ(regrets[i].missed, 0U);
    EXPECT_EQ(regrets[i].in_set.inputs, regrets[i].guaranteed);
  }
  EXPECT_EQ(regrets[0].guaranteed, 10U);
  EXPECT_EQ(regrets[0].fell_back, 0U);
}

TEST(EstimatorTrade, HasEveryEstimatorWithEveryNumberOfRays) {
  const FigureScene scene = readFigureScene(IRRADIFF_SCENE_FOLDER "/figure5.json");
  const EstimatorPlan plan{{64, 256}, 8, 2, 1, kSeed};
  const std::vector<EstimatorTrade> trades = estimatorTrades(scene, plan);
  for (const EstimatorChoice& choice : allEstimators()) {
    // Some know one of gradient and Hessian alone.
    const auto rows = std::ranges::count_if(
        trades, [&choice](const EstimatorTrade& trade) { return trade.estimator.label() == choice.label(); });
    EXPECT_TRUE(rows == 2 || rows == 4) << choice.label() << ": " << rows;
  }
  bool any_on_front = false;
  for (const EstimatorTrade& trade : trades) {
    EXPECT_GT(trade.microseconds.median, 0.0);
    EXPECT_LE(trade.rays, 256U);
    EXPECT_LE(trade.receivers, 8U);
    EXPECT_GE(trade.errors.peak, trade.errors.median);
    any_on_front = any_on_front || trade.on_front;
    if (trade.estimator.name == "discontinuity") {
      EXPECT_EQ(trade.estimate_share.median, 1.0);
    } else {
      EXPECT_LT(trade.estimate_share.median, 1.0);
    }
  }
  EXPECT_TRUE(any_on_front);
  // Errors depend on the plan alone.
  const std::vector<EstimatorTrade> again = estimatorTrades(scene, plan);
  ASSERT_EQ(again.size(), trades.size());
  for (std::size_t i = 0; i < trades.size(); ++i) EXPECT_EQ(again[i].errors.median, trades[i].errors.median);
}

}  // namespace
}  // namespace irradiff
