#include "experiments/pareto/regret.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace irradiff {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

/// Three inputs, three rounds. The first rule is fast and meets on input 0 alone; the second meets everywhere.
std::vector<MeasuredRule> twoRules() {
  return {{{true, false, false}, {{10, 12, 11}, {10, 10, 10}, {10, 10, 10}}},
          {{true, true, true}, {{30, 30, 30}, {40, 44, 42}, {50, 50, 50}}}};
}

TEST(Regret, IsTheChoosersTimeOverThatOfTheBestRuleForEachInput) {
  const Regret regret = regretOf({{20, 24, 22}, {40, 44, 42}, {50, 50, 50}}, twoRules(), {true, true, true});
  EXPECT_EQ(regret.inputs, 3U);
  EXPECT_THAT(regret.best_rules, ElementsAre(0U, 1U, 1U));
  // In the rounds 110/100, 118/106 and 114/103.
  EXPECT_THAT(regret.regret.low, DoubleEq(110.0 / 100.0));
  EXPECT_THAT(regret.regret.median, DoubleEq(114.0 / 103.0));
  EXPECT_THAT(regret.regret.high, DoubleEq(118.0 / 106.0));
  EXPECT_THAT(regret.chosen, DoubleEq(114.0 / 3.0));
  EXPECT_THAT(regret.best, DoubleEq(103.0 / 3.0));
}

TEST(Regret, IsOneForAChooserThatKnowsInAdvance) {
  const std::vector<MeasuredRule> rules = twoRules();
  const Regret regret =
      regretOf({rules[0].nanoseconds[0], rules[1].nanoseconds[1], rules[1].nanoseconds[2]}, rules, {true, true, true});
  EXPECT_EQ(regret.regret.low, 1.0);
  EXPECT_EQ(regret.regret.high, 1.0);
}

// A chooser that always takes the safe rule pays where the fast one would do; one that never chooses is not cheap
// because the fast rule, which misses the tolerance, is not counted.
TEST(Regret, CountsAFastRuleWhereItMeetsAlone) {
  const std::vector<MeasuredRule> rules = twoRules();
  EXPECT_GT(regretOf(rules[1].nanoseconds, rules, {true, false, false}).regret.median, 2.5);
  EXPECT_EQ(regretOf(rules[1].nanoseconds, rules, {false, true, true}).regret.median, 1.0);
}

TEST(Regret, LeavesOutInputsThatNoRuleMeetsOrThatDoNotCount) {
  std::vector<MeasuredRule> rules = twoRules();
  rules[1].meets[2] = false;
  const Regret regret = regretOf({{20, 20, 20}, {50, 50, 50}, {1, 1, 1}}, rules, {false, true, true});
  EXPECT_EQ(regret.inputs, 1U);
  EXPECT_THAT(regret.best_rules, ElementsAre(1U));
  EXPECT_EQ(regretOf({{20, 20, 20}, {50, 50, 50}, {1, 1, 1}}, rules, {false, false, true}).inputs, 0U);
  EXPECT_EQ(regretOf({}, {}, {}).inputs, 0U);
}

TEST(Spread, IsMedianAndRange) {
  const Spread odd = spreadOf({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.low, 1.0);
  EXPECT_EQ(odd.high, 3.0);
  EXPECT_EQ(spreadOf({4.0, 1.0, 2.0, 3.0}).median, 2.5);
  EXPECT_EQ(spreadText({1.234, 1.0, 1234.5}, 3), "1.23 (1 .. 1234)");
}

}  // namespace
}  // namespace irradiff
