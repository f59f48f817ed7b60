// Tables, page and conclusions of a study: they say what the numbers say, and other things when the numbers change.

#include "experiments/curves/study_text.h"

#include "experiments/curves/study_page.h"
#include "experiments/curves/study_tables.h"
#include "tests/curves/study_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using curves_test::publishedCurves;
using curves_test::sceneOf;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

MetricStudy studyWith(const ErrorCurves& curves) {
  MetricStudy study;
  study.plan = studyPlan(Effort::kQuick, 1);
  study.scenes.push_back(sceneOf(curves));
  RegionRatios ratios;
  ratios.metric = "occlusion-hessian";
  ratios.records = 1000;
  for (int i = 1; i <= 100; ++i) {
    ratios.radii.push_back(0.013 * i);
    ratios.errors.push_back(0.17 * i);
    ratios.kept.push_back(0.19 * i);
  }
  study.scenes.back().ratios = {ratios};
  return study;
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + '\n';
  return text;
}

/// One metric's errors for another's.
ErrorCurves exchanged(const std::string& a, const std::string& b) {
  ErrorCurves curves = publishedCurves();
  for (CurvePoint& point : curves.points) {
    if (point.metric == a) {
      point.metric = b;
    } else if (point.metric == b) {
      point.metric = a;
    }
  }
  return curves;
}

/// Numbers with a point in them: counts and places stand everywhere.
std::multiset<std::string> numbersIn(const std::string& text) {
  std::multiset<std::string> numbers;
  const std::regex number(R"([0-9]+\.[0-9]+)");
  for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it) numbers.insert(it->str());
  return numbers;
}

TEST(Conclusions, SayThePapersOrderWhereItIs) {
  const std::string text = joined(conclusionSentences(studyWith(publishedCurves())));
  EXPECT_THAT(text, AllOf(HasSubstr("of the published metrics occlusion-hessian has the least RMS error, 0.0071"),
                          HasSubstr("geometric-hessian with 0.0105"), HasSubstr("This is the order of the paper")));
  // Of 300, 1000 and 3000 records three each.
  EXPECT_THAT(text, AllOf(HasSubstr("ours, reprojection, has 0.3, 0.3 and 0.3 times"),
                          HasSubstr("1.5, 1.5 and 1.5 times"), HasSubstr("to the power of -0.75 for split-sphere")));
}

TEST(Conclusions, NoticeThatNumbersAreExchanged) {
  const std::string text = joined(conclusionSentences(studyWith(exchanged("occlusion-hessian", "split-sphere"))));
  EXPECT_THAT(text, AllOf(HasSubstr("split-sphere has the least RMS error, 0.0071"),
                          HasSubstr("split-sphere is number 1 in place of 4"), Not(HasSubstr("This is the order"))));
  EXPECT_THAT(joined(conclusionSentences(studyWith(exchanged("reprojection", "oracle")))),
              HasSubstr("0.667, 0.667 and 0.667 times that of the oracle"));
}

TEST(Conclusions, CountTheGoalsThatAreMet) {
  ErrorCurves curves = publishedCurves();
  const auto goals = [&] { return joined(conclusionSentences(studyWith(curves))); };
  for (CurvePoint& point : curves.points) {
    if (point.metric == "reprojection") point.error.rms *= 0.99;
  }
  EXPECT_THAT(goals(), HasSubstr("met in 6 of 6 cases"));
  for (CurvePoint& point : curves.points) {
    if (point.metric == "reprojection" && point.asked_records == 1000) point.error.rms *= 1.2;
  }
  EXPECT_THAT(goals(), HasSubstr("met in 5 of 6 cases"));
  for (CurvePoint& point : curves.points) {
    if (point.metric == "reprojection") point.error.rms *= 2.0;
  }
  EXPECT_THAT(goals(), HasSubstr("met in 0 of 6 cases"));
}

TEST(Conclusions, FollowTheRegions) {
  MetricStudy study = studyWith(publishedCurves());
  EXPECT_THAT(joined(conclusionSentences(study)), HasSubstr("occlusion-hessian is reckless and timid (radius 0.65"));
  for (double& ratio : study.scenes[0].ratios[0].errors) ratio *= 0.1;
  for (double& ratio : study.scenes[0].ratios[0].radii) ratio *= 1.5;
  EXPECT_THAT(joined(conclusionSentences(study)), HasSubstr("occlusion-hessian is safe (radius 0.975"));
}

TEST(Conclusions, SayWhereNoiseDecides) {
  MetricStudy study = studyWith(publishedCurves());
  EXPECT_THAT(joined(conclusionSentences(study)), Not(HasSubstr("noise")));
  study.scenes[0].gather_error = 0.0068;
  // 1.5 times that is between 0.0071 of occlusion-hessian and 0.0105 of geometric-hessian.
  EXPECT_THAT(
      joined(conclusionSentences(study)),
      HasSubstr("an RMS error of 0.0068; at 1700 records occlusion-hessian, reprojection and oracle are within"));
  study.scenes[0].gather_error = 0.0071;
  EXPECT_THAT(joined(conclusionSentences(study)), HasSubstr("records geometric-hessian, occlusion-hessian,"));
}

// Every number in the conclusions stands in a table of the same page once more.
TEST(StudyPage, ShowsEveryNumberThatItQuotes) {
  MetricStudy study = studyWith(publishedCurves());
  study.scenes[0].gather_error = 0.0068;
  std::string page = studyPage(study, recordOfThisProgram(), {{"<svg></svg>", "<svg></svg>"}});
  const std::size_t first = page.find("id=\"conclusion\"");
  const std::size_t last = page.find("<h2", first);
  const std::multiset<std::string> quoted = numbersIn(page.substr(first, last - first));
  page.erase(first, last - first);
  // What the guide says of the goals is no measurement.
  const std::multiset<std::string> shown = numbersIn(page);
  EXPECT_GT(quoted.size(), 20U);
  for (const std::string& number : quoted) {
    const bool is_goal = number == "0.5" || number == "1.5";
    EXPECT_TRUE(is_goal || shown.contains(number)) << number;
  }
}

TEST(StudyPage, HasWhatIsNeededForTheSlider) {
  const std::string page =
      studyPage(studyWith(publishedCurves()), recordOfThisProgram(), {{"<svg></svg>", "<svg></svg>"}});
  EXPECT_THAT(page, AllOf(HasSubstr("class=\"slider screen\" hidden"), HasSubstr("data-name=\"reference\""),
                          HasSubstr("<script>"), Not(HasSubstr("http://")), Not(HasSubstr("https://"))));
}

TEST(StudySection, HasConclusionsAndTables) {
  const FurtherSection section = studySection(studyWith(publishedCurves()), "metrics/index.html");
  EXPECT_EQ(section.title, "Error metrics");
  EXPECT_THAT(section.html, AllOf(HasSubstr("href=\"metrics/index.html\""), HasSubstr("the least RMS error"),
                                  HasSubstr("Figure 1 at 1700 records"), Not(HasSubstr("<script"))));
}

TEST(StudyMarkdown, HasTheTablesAndNoFolder) {
  RunRecord record = recordOfThisProgram();
  record.command = {"irradiff", "curves", "--output", "somewhere", "--effort", "quick"};
  record.threads = 2;
  const std::string text = studyMarkdown(studyWith(publishedCurves()), record);
  EXPECT_THAT(text, AllOf(HasSubstr("`./run curves --effort quick`"), Not(HasSubstr("somewhere")),
                          HasSubstr("| occlusion-hessian | 0.0071 |"), HasSubstr("## What we conclude")));
}

TEST(StudyTables, HaveEveryPointAndAgree) {
  const MetricStudy study = studyWith(publishedCurves());
  const Json curves = Json::parse(curveTable(study).json());
  ASSERT_EQ(curves.size(), 28U);
  EXPECT_EQ(curves[0].at("scene"), "cornell_box");
  EXPECT_EQ(curves[0].at("metric"), "split-sphere");
  EXPECT_EQ(curves[0].at("asked_records"), 300);
  EXPECT_EQ(curves[0].at("rms"), study.scenes[0].curves.points[0].error.rms);
  EXPECT_THAT(curveTable(study).csv(), HasSubstr("scene,metric,field,asked_records,records,rays,threshold,is_within"));
  const Json slopes = Json::parse(slopeTable(study).json());
  ASSERT_EQ(slopes.size(), 7U);
  EXPECT_NEAR(slopes[3].at("slope").get<double>(), -0.75, 1e-13);
  const Json ratios = Json::parse(ratioTable(study).json());
  ASSERT_EQ(ratios.size(), 3U);
  EXPECT_EQ(ratios[1].at("ratio"), "error");
  EXPECT_DOUBLE_EQ(ratios[1].at("median").get<double>(), 8.5);
  const Json order = Json::parse(orderTable(study).json());
  ASSERT_EQ(order.size(), 7U);
  EXPECT_EQ(order[4].at("published_rms"), 0.0071);
  EXPECT_TRUE(order[6].at("published_rms").is_null()) << "the paper has no oracle";
  EXPECT_EQ(order[1].at("rank"), 3);
}

}  // namespace
}  // namespace irradiff
