// Variants side by side, the paper's figures over a field of known light, and how alike distributions are.

#include "experiments/curves/cache_comparison.h"

#include "experiments/curves/error_curves.h"
#include "experiments/curves/paper_figures.h"
#include "tests/curves/study_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using curves_test::publishedField;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t kWidth = 40;

const std::vector<CacheComparison>& figures() {
  static const RecordField field = publishedField(kWidth);
  static const std::vector<CacheComparison> all = paperFigures({&field, &field, &field, &field}, 150, 2);
  return all;
}

const CacheComparison& figure(const std::string& id) { return *std::ranges::find(figures(), id, &CacheComparison::id); }

TEST(PaperFigures, AreThoseOfThePaper) {
  std::vector<std::string> ids;
  for (const CacheComparison& comparison : figures()) ids.push_back(comparison.id);
  EXPECT_THAT(ids,
              ElementsAre("figure7", "figure8", "figure9", "figure10", "figure11", "figure12", "figure13", "figure14"));
  for (const CacheComparison& comparison : figures()) {
    EXPECT_GE(comparison.results.size(), 2U) << comparison.id;
    EXPECT_FALSE(comparison.findings.empty()) << comparison.id;
    for (const VariantResult& result : comparison.results) {
      EXPECT_TRUE(result.is_within) << comparison.id << ' ' << result.label;
      EXPECT_EQ(result.footprints.image.width, kWidth);
      EXPECT_EQ(result.rays, 100 * result.records);
    }
  }
}

TEST(PaperFigures, LeaveOutWhatHasNoField) {
  const RecordField field = publishedField(24);
  const std::vector<CacheComparison> some = paperFigures({nullptr, nullptr, &field, nullptr}, 50, 1);
  ASSERT_EQ(some.size(), 1U);
  EXPECT_EQ(some[0].id, "figure14");
}

// Circles within the error cover less than ellipses: more of them are needed at the same threshold.
TEST(PaperFigures, HaveRoundAndElongatedRecordsAtOneThreshold) {
  const std::vector<VariantResult>& results = figure("figure8").results;
  ASSERT_EQ(results.size(), 4U);
  for (std::size_t i = 0; i < 4; i += 2) {
    EXPECT_EQ(results[i].threshold, results[i + 1].threshold);
    EXPECT_GT(results[i].records, results[i + 1].records) << results[i].label;
  }
  EXPECT_THAT(figure("figure8").findings[0], HasSubstr(std::to_string(results[0].records) + " round records against " +
                                                       std::to_string(results[1].records)));
}

// Here the field of few rays is the field of many: they are as alike as can be, and the twin is not.
TEST(PaperFigures, TellHowAlikeDistributionsAre) {
  const CacheComparison& few = figure("figure10");
  EXPECT_THAT(few.findings[0], HasSubstr("correlate to 1; of the records 0 %"));
  EXPECT_THAT(few.findings[1], testing::Not(HasSubstr("correlate to 1;")));
  EXPECT_EQ(few.results[0].records, few.results[1].records);
}

TEST(PaperFigures, DoNotDependOnThreads) {
  const RecordField field = publishedField(24);
  const auto one = paperFigures({nullptr, nullptr, &field, &field}, 50, 1);
  const auto three = paperFigures({nullptr, nullptr, &field, &field}, 50, 3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].findings, three[i].findings);
    for (std::size_t k = 0; k < one[i].results.size(); ++k) {
      EXPECT_EQ(one[i].results[k].error.rms, three[i].results[k].error.rms);
      EXPECT_TRUE(one[i].results[k].footprints.image.pixels == three[i].results[k].footprints.image.pixels);
    }
  }
}

Placement placementAt(const std::vector<std::size_t>& receivers) {
  Placement placement;
  placement.record_receivers = receivers;
  placement.records.resize(receivers.size());
  return placement;
}

TEST(Likeness, IsZeroForTheSameAndOneForDisjointCells) {
  const RecordField field = publishedField(kWidth);
  std::vector<double> radii;
  for (std::size_t i = 0; i < field.receivers.size(); ++i) radii.push_back(1.0 + static_cast<double>(i));
  std::vector<double> inverse = radii;
  for (double& radius : inverse) radius = 1.0 / radius;
  const Placement left = placementAt({0, 1, kWidth, kWidth + 1});
  const Placement right = placementAt({kWidth - 1, 2 * kWidth - 1});
  const DistributionLikeness same = likeness(field, radii, left, radii, left);
  EXPECT_NEAR(same.radius_correlation, 1.0, 1e-12);
  EXPECT_EQ(same.density_difference, 0.0);
  const DistributionLikeness other = likeness(field, radii, left, inverse, right);
  EXPECT_NEAR(other.radius_correlation, -1.0, 1e-12);
  EXPECT_EQ(other.density_difference, 1.0);
  EXPECT_GT(other.chance_difference, 0.0);
}

// Records thrown with one density differ by what is said of chance.
TEST(Likeness, KnowsWhatChanceDoes) {
  const RecordField field = publishedField(kWidth);
  const std::vector<double> radii(field.receivers.size(), 1.0);
  std::uint64_t state = 1;
  const auto next = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>((state >> 33U) % (kWidth * kWidth));
  };
  double measured = 0.0;
  double expected = 0.0;
  for (int i = 0; i < 50; ++i) {
    std::vector<std::size_t> a(400);
    std::vector<std::size_t> b(600);
    std::ranges::generate(a, next);
    std::ranges::generate(b, next);
    const DistributionLikeness like = likeness(field, radii, placementAt(a), radii, placementAt(b));
    measured += like.density_difference / 50;
    expected += like.chance_difference / 50;
    EXPECT_TRUE(std::isnan(like.radius_correlation)) << "constant radii correlate with nothing";
  }
  // Counts of some 3 in a cell are not quite normal.
  EXPECT_NEAR(measured / expected, 1.0, 0.1);
}

}  // namespace
}  // namespace irradiff
