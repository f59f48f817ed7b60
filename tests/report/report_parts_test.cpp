#include "tests/report/report_text.h"
#include "verification/report/check_legend.h"
#include "verification/report/figure_text.h"
#include "verification/report/headline.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/parallel_tasks.h"
#include "verification/report/report_tables.h"
#include "verification/report/result_folder.h"
#include "verification/report/summary_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <unistd.h>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A report with one promised formula and one verdict.
AccuracyReport reportOf(const Verdict& verdict) {
  AccuracyReport report;
  report.formulas.push_back({"mine", "a formula", true, false, {verdict}, {}});
  return report;
}

Verdict verdictOf(double peak, bool passed) {
  Verdict verdict;
  verdict.candidate = "mine";
  verdict.check = "multiprecision";
  verdict.family = "well-conditioned";
  verdict.quantity = Quantity::kHessian;
  verdict.passed = passed;
  verdict.inputs = 7;
  verdict.peak = peak;
  verdict.rms = peak;
  verdict.tolerance = 2e-14;
  verdict.worst_input = R"({"a":"<&>, \"quoted\""})";
  return verdict;
}

TEST(FigureText, HasTwoDigits) {
  EXPECT_EQ(figureText(0.0), "0");
  EXPECT_EQ(figureText(3.44e-15), "3.4e-15");
  EXPECT_EQ(figureText(0.0934), "0.093");
  EXPECT_EQ(figureText(123.4), "123");
  EXPECT_EQ(figureText(12345.0), "1.2e+04");
  EXPECT_EQ(figureText(kInfinity), "infinite");
  EXPECT_EQ(figureText(kNan), "not a number");
  EXPECT_EQ(epsilonText(0x1p-52), "1");
  EXPECT_EQ(figureText(std::optional<double>()), "-");
}

TEST(FigureText, GroupsCountsByThousands) {
  EXPECT_EQ(countText(999), "999");
  EXPECT_EQ(countText(1000), "1 000");
  EXPECT_EQ(countText(12345678), "12 345 678");
}

TEST(Html, EscapesEverythingThatIsMarkup) {
  EXPECT_EQ(escaped(R"(<a b="c" d='e'>&)"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
}

TEST(Html, FindsTagsThatAreNotBalanced) {
  EXPECT_EQ(unbalancedTag("<!DOCTYPE html><p>a<br>b</p>"), "");
  EXPECT_EQ(unbalancedTag("<p title=\"a > b\">a</p>"), "");
  EXPECT_NE(unbalancedTag("<p>a"), "");
  EXPECT_NE(unbalancedTag("<p><b>a</p></b>"), "");
  EXPECT_NE(unbalancedTag("a < b"), "");
}

TEST(Html, InlinesPlotsWithIdsOfTheirOwn) {
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">"
      "<title>Gnuplot</title><path id='p'/><use xlink:href='#p'/><g clip-path=\"url(#p)\"></g></svg>";
  const std::string inlined = inlineSvg(svg, "one", "A & B");
  EXPECT_EQ(inlined,
            "<svg role=\"img\" aria-label=\"A &amp; B\"><title>A &amp; B</title><path id=\"one-p\"/>"
            "<use xlink:href=\"#one-p\"/><g clip-path=\"url(#one-p)\"></g></svg>");
  EXPECT_THROW(inlineSvg("no picture", "one", "A"), std::runtime_error);
}

TEST(Html, TableRefusesRowsOfAnotherLength) {
  HtmlTable table({"a", "b"});
  EXPECT_THROW(table.add({"only one"}), std::invalid_argument);
}

TEST(Legend, RefusesAnUnexplainedCheck) {
  EXPECT_EQ(explanationOf("closed form B-4").check, "closed form");
  EXPECT_THROW(explanationOf("horoscope"), std::invalid_argument);
}

TEST(Summary, SaysWrongWhenAPromiseIsBroken) {
  const AccuracyReport wrong = reportOf(verdictOf(1.0, false));
  EXPECT_EQ(exitStatusOf(wrong), 1);
  EXPECT_THAT(plainText(summarySentences(wrong)), HasSubstr("WRONG: 1 of 1 checks"));
  EXPECT_THAT(summarySection(wrong, {}), HasSubstr("class=\"verdict wrong\""));

  const AccuracyReport right = reportOf(verdictOf(1e-15, true));
  EXPECT_EQ(exitStatusOf(right), 0);
  EXPECT_THAT(plainText(summarySentences(right)), Not(HasSubstr("WRONG")));
  EXPECT_THAT(summarySection(right, {}), HasSubstr("class=\"verdict right\""));
}

TEST(Summary, AFailureWithoutAPromiseIsNoDefect) {
  AccuracyReport report = reportOf(verdictOf(1.0, false));
  report.formulas[0].is_promised = false;
  EXPECT_EQ(exitStatusOf(report), 0);
}

TEST(Summary, AnErratumThatIsNotBorneOutIsWrong) {
  AccuracyReport report = reportOf(verdictOf(1e-15, true));
  ErratumMeasurement measurement{"F", "an oracle", 3, 0.5, 0.6, 1e-20, 1e-15};
  report.errata.push_back({"Equation (1)", "a sign", "-", "+", "", {measurement}});
  EXPECT_EQ(exitStatusOf(report), 0);
  report.errata[0].measurements[0].corrected_largest = 1e-14;
  EXPECT_EQ(exitStatusOf(report), 1) << "the corrected formula is off";
  report.errata[0].measurements[0] = measurement;
  report.errata[0].measurements[0].printed_largest = 1e-15;
  EXPECT_EQ(exitStatusOf(report), 1) << "the printed formula is right";
  report.errata[0].measurements[0] = measurement;
  report.errata[0].measurements[0].inputs = 0;
  EXPECT_EQ(exitStatusOf(report), 1) << "nothing was measured";
}

TEST(Headline, NotANumberIsTheWorst) {
  std::optional<double> worst;
  for (const double value : {1.0, kNan, 2.0}) {
    raiseTo(worst, value);
  }
  EXPECT_TRUE(std::isnan(*worst));
}

TEST(Tables, CsvReadsBack) {
  const Verdict verdict = verdictOf(0.1, false);
  const auto rows = parseCsv(verdictsCsv(reportOf(verdict)));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].front(), "formula");
  ASSERT_EQ(rows[1].size(), rows[0].size());
  EXPECT_THAT(rows[1], testing::Contains(verdict.worst_input));
  EXPECT_THAT(rows[1], testing::Contains("0.1"));
}

/// A report on one family: six partly hidden scenes, of which two have no apparent vertex.
AccuracyReport reportOfGapFilling(const std::vector<double>& errors) {
  AccuracyReport report;
  report.gap_filling.push_back({"screens", "some", {errors, 2}});
  return report;
}

std::size_t countOf(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++count;
  return count;
}

TEST(GapFilling, IsShownByDecade) {
  const AccuracyReport report = reportOfGapFilling({0.5, 0.05, 20.0, 0.7});
  const std::string html = gapFillingSection(report);
  EXPECT_EQ(unbalancedTag(html), "");
  EXPECT_THAT(html, HasSubstr("Of 6 partly hidden scenes 2 have no apparent vertex, and lose nothing. Of the other 4 "
                              "half lose at least 0.7 of the Hessian and one in ten at least 20 of it; 75.0 % lose "
                              "more than a tenth."));
  // All scenes, and those of the family: the tallest bar holds half of them, two hold a quarter each.
  EXPECT_EQ(countOf("height=\"120\" fill", html), 2U);
  EXPECT_EQ(countOf("height=\"60\" fill", html), 4U);
  EXPECT_EQ(countOf("height=\"0\" fill", html), 16U);
  const auto rows = parseCsv(gapFillingCsv(report));
  ASSERT_EQ(rows.size(), 13U);
  EXPECT_THAT(rows[1], testing::ElementsAre("screens", "false", "0", "0", "2"));
  EXPECT_THAT(rows[2], testing::ElementsAre("screens", "true", "0", "1e-08", "0"));
  EXPECT_THAT(rows[9], testing::ElementsAre("screens", "true", "0.01", "0.1", "1"));
  EXPECT_THAT(rows[10], testing::ElementsAre("screens", "true", "0.1", "1", "2"));
  EXPECT_THAT(rows[12], testing::ElementsAre("screens", "true", "10", "inf", "1"));
}

// What the page would be if the motion of apparent vertices were worth nothing, or nothing had been measured.
TEST(GapFilling, WorthNothingLooksLikeIt) {
  const std::string zero = gapFillingSection(reportOfGapFilling({0.0, 0.0, 0.0, 0.0}));
  EXPECT_THAT(zero, HasSubstr("half lose at least 0 of the Hessian"));
  EXPECT_THAT(zero, HasSubstr("0.0 % lose more than a tenth"));
  const std::string none = gapFillingSection(reportOfGapFilling({}));
  EXPECT_THAT(none, HasSubstr("nothing was measured"));
  EXPECT_THAT(none, Not(HasSubstr("<svg")));
}

TEST(Tightness, IsBoundOverErrorWithoutWhatIsExact) {
  std::vector<BoundAndError> values;
  for (int i = 1; i <= 200; ++i) values.push_back({2.0 * i, 2.0});
  values.push_back({1.0, 0.0});
  values.push_back({kInfinity, 1.0});
  const BoundTightness tightness = tightnessOf(values);
  EXPECT_EQ(tightness.values, 202U);
  EXPECT_EQ(tightness.exact, 1U);
  EXPECT_EQ(tightness.unbounded, 1U);
  EXPECT_EQ(tightness.least, 1.0);
  EXPECT_EQ(tightness.median, 100.0);
  EXPECT_EQ(tightness.percentile_99, 198.0);
  EXPECT_EQ(tightness.largest, 200.0);
  EXPECT_TRUE(tightness.holds());
  EXPECT_EQ(figuresOf(tightness), "1, 100, 198, 200; 1 exact; 1 without a bound");
  EXPECT_EQ(figuresOf(tightnessOf({{0.0, 0.0}})), "1 exact");
  EXPECT_EQ(figuresOf(tightnessOf({})), "-");
}

TEST(Tightness, ABoundBelowTheErrorIsWrong) {
  for (const BoundAndError& wrong : {BoundAndError{0.99, 1.0}, {kNan, 1.0}, {1.0, kNan}, {0.0, 1e-300}}) {
    AccuracyReport report = reportOf(verdictOf(1e-15, true));
    EXPECT_EQ(exitStatusOf(report), 0);
    report.tightness.assign(kQuantities.size(), tightnessOf({{3.0, 1.0}}));
    EXPECT_EQ(exitStatusOf(report), 0);
    report.tightness.back() = tightnessOf({{3.0, 1.0}, wrong});
    EXPECT_EQ(exitStatusOf(report), 1) << wrong.bound << ' ' << wrong.error;
    EXPECT_THAT(plainText(summarySentences(report)), HasSubstr("WRONG: 1 reported bounds are below"));
    EXPECT_THAT(tightnessSection(report), HasSubstr("1 bounds are exceeded"));
    EXPECT_EQ(unbalancedTag(tightnessSection(report)), "");
  }
}

TEST(Tasks, RunOnceEachAndReportTheLowestFailure) {
  std::vector<int> runs(50, 0);
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    tasks.emplace_back([&runs, i] { ++runs[i]; });
  }
  std::size_t last = 0;
  runTasks(tasks, 4, [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(done, last + 1);
    EXPECT_EQ(all, 50U);
    last = done;
  });
  EXPECT_EQ(last, 50U);
  EXPECT_THAT(runs, testing::Each(1));
  tasks[0] = [] { throw std::runtime_error("first"); };
  EXPECT_THROW(runTasks(tasks, 1, nullptr), std::runtime_error);
}

/// A folder of its own for tests of what is written.
class ResultFolderTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(root_); }
  void TearDown() override { fs::remove_all(root_); }

  void put(const fs::path& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(root_), fs::directory_iterator()));
  }

  const fs::path root_ = fs::temp_directory_path() / ("irradiff-report-test-" + std::to_string(getpid()));
  const std::string run_ = R"({"format": "irradiff-run", "command": ["irradiff", "report"]})";
};

TEST_F(ResultFolderTest, AppearsWholeOrNotAtAll) {
  {
    const ResultFolder folder(root_ / "out", "report");
    folder.write("index.html", "half");
    EXPECT_FALSE(fs::exists(root_ / "out"));
  }
  EXPECT_EQ(entries(), 0U);
  ResultFolder folder(root_ / "out/", "report");
  folder.write("plots/a.svg", "picture");
  folder.commit();
  EXPECT_TRUE(fs::exists(root_ / "out/plots/a.svg"));
  EXPECT_EQ(entries(), 1U);
}

TEST_F(ResultFolderTest, ReplacesAReportWithAllThatIsInIt) {
  put("out/run.json", run_);
  put("out/old.txt", "old");
  ResultFolder folder(root_ / "out", "report");
  folder.write("run.json", run_);
  EXPECT_TRUE(fs::exists(root_ / "out/old.txt")) << "the old report stays until the new one is whole";
  folder.commit();
  EXPECT_FALSE(fs::exists(root_ / "out/old.txt"));
  EXPECT_EQ(entries(), 1U);
}

TEST_F(ResultFolderTest, AFailedReportLeavesTheOldOneWhole) {
  put("out/run.json", run_);
  put("out/old.txt", "old");
  EXPECT_THROW(
      {
        const ResultFolder folder(root_ / "out", "report");
        folder.write("run.json", run_);
        throw std::runtime_error("a plot could not be made");
      },
      std::runtime_error);
  EXPECT_TRUE(fs::exists(root_ / "out/old.txt"));
  EXPECT_EQ(entries(), 1U);
}

TEST_F(ResultFolderTest, RefusesWhatIsNoReport) {
  put("thesis/chapter.tex", "years of work");
  put("run/run.json", R"({"format": "irradiff-run", "command": ["irradiff", "figure"]})");
  put("broken/run.json", "{");
  put("file", "text");
  for (const char* name : {"thesis", "run", "broken", "file"}) {
    EXPECT_THROW(ResultFolder(root_ / name, "report"), RefusedFolder) << name;
  }
  EXPECT_THROW(ResultFolder("", "report"), RefusedFolder);
  EXPECT_TRUE(fs::exists(root_ / "thesis/chapter.tex"));
  EXPECT_EQ(entries(), 4U);
}

TEST_F(ResultFolderTest, RefusesWhatHasComeInTheMeantime) {
  ResultFolder folder(root_ / "out", "report");
  folder.write("run.json", run_);
  put("out/thesis.tex", "years of work");
  EXPECT_THROW(folder.commit(), RefusedFolder);
  EXPECT_TRUE(fs::exists(root_ / "out/thesis.tex"));
}

}  // namespace
}  // namespace irradiff
