#include "experiments/pareto/pareto_page.h"
#include "experiments/pareto/trade_plot.h"
#include "experiments/pareto/trade_tables.h"
#include "tests/report/report_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::Not;

/// By hand: two methods, one of them without a comparison; a regret above what is asked and one of nothing.
Pareto small() {
  Pareto pareto;
  pareto.plan = paretoPlan(Effort::kQuick, 3);
  FamilyTrade family{"generic", "a <family>", 4, {}};
  MethodTrade fast{"fast & wrong", MethodGroup::kAppendix, 4, {}, {100, 90, 120}, {1, 1, 1}, true};
  for (ErrorStatistics& errors : fast.errors) errors = {1e-4, 2e-3, std::numeric_limits<double>::infinity()};
  MethodTrade absent{"absent", MethodGroup::kArea, 0, {}, {50, 50, 50}, {0.5, 0.5, 0.5}, false};
  family.methods = {fast, absent};
  pareto.families.push_back(family);
  RuleRegret bad;
  bad.family = "generic";
  bad.tolerance = 1e-3;
  bad.inputs = bad.guaranteed = 4;
  bad.missed = 2;
  bad.broken = 1;
  bad.in_set = {4, {1.7, 1.6, 1.8}, 170, 100, {0, 0, 0, 0}};
  bad.of_all = bad.in_set;
  bad.without_tolerance = 340;
  RuleRegret nothing;
  nothing.family = "sliver";
  nothing.tolerance = 1e-12;
  nothing.inputs = 4;
  pareto.regrets = {bad, nothing};
  EstimatorTrade estimator;
  estimator.estimator = {"ward-heckbert", Stratification::kConcentric};
  estimator.rays = 64;
  estimator.receivers = 8;
  estimator.errors = {0.1, 0.2, 0.3};
  estimator.microseconds = {10, 9, 12};
  estimator.estimate_share = {0.25, 0.2, 0.3};
  estimator.on_front = true;
  pareto.estimators = {estimator};
  return pareto;
}

TEST(ParetoTables, HaveWhatWasCompared) {
  const auto rows = parseCsv(tradeTable(small()).csv());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1][1], "fast & wrong");
  EXPECT_EQ(rows[1][8], "100");
  EXPECT_EQ(parseCsv(errorTable(small()).csv()).size(), 1U + 4U);
  EXPECT_EQ(parseCsv(regretTable(small()).csv()).size(), 3U);
  EXPECT_EQ(parseCsv(estimatorTable(small()).csv())[1][2], "64");
}

TEST(ParetoTables, KeepTimesOutOfTheErrors) {
  const auto header = parseCsv(errorTable(small()).csv())[0];
  EXPECT_THAT(header, Each(Not(HasSubstr("seconds"))));
  EXPECT_THAT(header, Each(Not(HasSubstr("ratio"))));
}

TEST(ParetoPage, SaysWhatIsWrong) {
  const Pareto pareto = small();
  const std::string text = paretoSentences(pareto)[0] + paretoSentences(pareto)[1];
  EXPECT_THAT(text, HasSubstr("at most 1.3 in 0 of 1 combinations"));
  EXPECT_THAT(text, HasSubstr("1.7 (1.6 .. 1.8), on generic at 1e-03"));
  EXPECT_THAT(text, HasSubstr("WRONG: it broke its word on 1 inputs, and gave up on 2 where"));
  EXPECT_THAT(text, HasSubstr("is 2 (2 .. 2) times as fast"));
  const std::string page = paretoPage(pareto, recordOfThisProgram(), tradePlot(pareto));
  EXPECT_EQ(unbalancedTag(page), "");
  EXPECT_THAT(page, HasSubstr("fast &amp; wrong"));
  EXPECT_THAT(page, HasSubstr("a &lt;family&gt;"));
  EXPECT_THAT(page, HasSubstr("above 1.3"));
  EXPECT_THAT(page, Not(HasSubstr("absent")));
}

TEST(ParetoPlot, HasAPanelForEachFamily) {
  const std::string svg = tradePlot(small());
  EXPECT_THAT(svg, HasSubstr(">generic<"));
  EXPECT_THAT(svg, HasSubstr(">Pareto front<"));
  EXPECT_THAT(svg, HasSubstr("tangential Hessian"));
}

TEST(Pareto, NamesAFamilyThatDoesNotExist) {
  ParetoPlan plan = paretoPlan(Effort::kQuick, 1);
  plan.families = {"nonsense"};
  try {
    measurePareto(plan, {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("nonsense"));
  }
}

}  // namespace
}  // namespace irradiff
