#include "experiments/figures/estimator_comparison.h"

#include "experiments/figures/estimator_section.h"
#include "tests/report/report_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kBox = IRRADIFF_SCENE_FOLDER "/black_square_in_box.json";
const ComparisonPlan kPlan{256, 6, 3, 7};

EstimatorComparison boxComparison(unsigned threads) {
  const FigureScene box = readFigureScene(kBox);
  return compareEstimators({box}, box, kPlan, threads);
}

std::vector<std::string> allLabels() {
  std::vector<std::string> labels;
  for (const EstimatorChoice& choice : allEstimators()) labels.push_back(choice.label());
  return labels;
}

template <class Row>
std::vector<std::string> labelsOf(const std::vector<Row>& rows) {
  std::vector<std::string> labels;
  labels.reserve(rows.size());
  for (const Row& row : rows) labels.push_back(row.estimator.label());
  return labels;
}

TEST(EstimatorComparison, HasEveryEstimatorInItsOrder) {
  const EstimatorComparison comparison = boxComparison(2);
  ASSERT_EQ(comparison.scenes.size(), 1U);
  EXPECT_EQ(labelsOf(comparison.scenes[0].errors), allLabels());
  EXPECT_EQ(labelsOf(comparison.leaks), allLabels());
  for (const EstimatorErrors& row : comparison.scenes[0].errors) {
    EXPECT_TRUE(row.gradient || row.hessian) << row.estimator.label();
    EXPECT_LE(row.rays, kPlan.rays) << row.estimator.label();
    EXPECT_GT(row.rays, kPlan.rays / 2) << row.estimator.label();
  }
}

// The errors are those of the maps that `irradiff figure 5` makes of the same plan.
TEST(EstimatorComparison, TellsTheErrorsOfMaps) {
  const EstimatorComparison comparison = boxComparison(1);
  const FigureScene box = readFigureScene(kBox);
  const ReceiverGrid grid = withResolution(*box.scene.grid, kPlan.resolution);
  const AnalyticFigure exact = analyticFigure(box, grid, 1);
  const SamplingPlan sampling{Stratification::kConcentric, {16, 16}, SamplePattern::kJittered, kPlan.seed};
  const std::vector<std::string> names{"triangulated"};
  const EstimateMap map = estimateMaps(box.scene.polygons, grid, sampling, names, 1, nullptr, 0).at(0);
  const ErrorSummary expected = summarise(map, exact.map, Compared::kHessian);
  const auto& rows = comparison.scenes[0].errors;
  const auto row =
      std::ranges::find(rows, "triangulated", [](const EstimatorErrors& r) { return r.estimator.label(); });
  ASSERT_NE(row, rows.end());
  ASSERT_TRUE(row->hessian);
  EXPECT_GT(row->hessian->compared, 20U);
  EXPECT_EQ(row->hessian->median, expected.median);
  EXPECT_EQ(row->hessian->percentile99, expected.percentile99);
  EXPECT_EQ(row->hessian->rms, expected.rms);
}

TEST(EstimatorComparison, DoesNotDependOnThreads) {
  EXPECT_EQ(comparisonTable(boxComparison(1), {}).csv(), comparisonTable(boxComparison(3), {}).csv());
}

// The occluders of Figure 5 have apparent vertices; in the box the Hessian in space exists nowhere.
TEST(EstimatorComparison, KnowsWhatFilledGapsCost) {
  const FigureScene figure5 = readFigureScene(IRRADIFF_SCENE_FOLDER "/figure5.json");
  const FigureScene box = readFigureScene(kBox);
  const EstimatorComparison comparison = compareEstimators({figure5, box}, box, {16, 12, 1, 7}, 2);
  ASSERT_TRUE(comparison.scenes[0].gap_share);
  EXPECT_GT(*comparison.scenes[0].gap_share, 0.01);
  EXPECT_LT(*comparison.scenes[0].gap_share, 1.0);
  EXPECT_FALSE(comparison.scenes[1].gap_share);
}

// The truth is 0: the derivatives of constant radiance.
TEST(EstimatorComparison, ConstantRadianceGivesZeroWhereThatIsClaimed) {
  const EstimatorComparison comparison = boxComparison(2);
  std::vector<std::string> claiming;
  for (const ConstantRadianceLeak& leak : comparison.leaks) {
    if (leak.claims_zero) {
      claiming.push_back(leak.estimator.label());
      EXPECT_TRUE(isClosed(leak, kPlan)) << leak.estimator.label();
    }
    // The mesh that ends at the outermost samples is open: what is asked can be missed.
    if (leak.estimator.label() == "triangulated") {
      EXPECT_FALSE(isClosed(leak, kPlan));
      EXPECT_GT(leak.hessian.value(), 0.1);
    }
  }
  EXPECT_THAT(claiming, testing::UnorderedElementsAre("ward-heckbert", "ward-heckbert (polar)", "triangulated-closed",
                                                      "discontinuity"));
  EXPECT_THAT(comparisonSentences(comparison), testing::Contains("Every estimator that claims to give 0 does."));
}

EstimatorErrors errorsOf(const char* name, double median) {
  ErrorSummary summary;
  summary.compared = 5;
  summary.median = median;
  summary.percentile99 = 10.0 * median;
  return {{name, Stratification::kConcentric}, 256, summary, {}};
}

/// Of two estimators, the second of which is better.
EstimatorComparison madeUp(double second_leak) {
  EstimatorComparison comparison;
  comparison.plan = kPlan;
  FigureScene scene;
  scene.name = "lamp.json";
  comparison.scenes.push_back({scene, {}, {errorsOf("first", 0.25), errorsOf("second", 0.125)}, 0.5});
  comparison.leaks = {{{"first", Stratification::kConcentric}, false, 0.5, {}},
                      {{"second", Stratification::kConcentric}, true, second_leak, {}}};
  return comparison;
}

TEST(EstimatorSection, SaysWhatTheNumbersSay) {
  const std::vector<std::string> sentences = comparisonSentences(madeUp(0.0));
  EXPECT_THAT(sentences,
              testing::ElementsAre(
                  "In lamp.json the least median error of the gradient is that of second (0.12; 99 % of "
                  "the receivers have at most 1.2), the next that of first (0.25; 99 % of the receivers "
                  "have at most 2.5).",
                  "In lamp.json filled gaps alone, without any noise, cost 50 % of the receivers more than a tenth of "
                  "the Hessian in space: meshes over samples fill them.",
                  "Constant radiance gives derivatives of 0, to rounding (at most 1.8e-13), with second.",
                  "It does not with first (0.5 W/m³).", "Every estimator that claims to give 0 does."));
  const std::string html = estimatorSection(madeUp(0.0), {}).html;
  EXPECT_EQ(unbalancedTag(html), "");
  EXPECT_THAT(html, HasSubstr("0, as claimed"));
  EXPECT_THAT(html, Not(HasSubstr("WRONG")));
}

// The bad twin: it claims to give 0, and does not by a little.
TEST(EstimatorSection, SaysWhoClaimsZeroWrongly) {
  const EstimatorComparison comparison = madeUp(1e-12);
  EXPECT_THAT(comparisonSentences(comparison), testing::Contains("WRONG: second claims to give 0."));
  EXPECT_THAT(estimatorSection(comparison, {}).html, HasSubstr("WRONG: claims 0"));
}

}  // namespace
}  // namespace irradiff
