#include "derivatives/form_factor/polygon_evaluation.h"
#include "tests/cli/program_run.h"
#include "tests/report/report_text.h"
#include "verification/report/accuracy_report.h"
#include "verification/report/figure_text.h"
#include "verification/report/html.h"
#include "verification/report/run_record.h"
#include "verification/report/write_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::vector<std::string> kTables = {"verdicts", "sweeps", "errata", "gap_filling", "bound_tightness"};

/// One quick report by the program, shared by the tests.
class QuickReport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchFolder;
    run_ = new ProgramRun(runProgram({"report", "--output", folder().string(), "--effort", "quick", "--threads", "2"}));
  }
  static void TearDownTestSuite() {
    delete run_;
    delete scratch_;
  }

  static fs::path folder() { return scratch_->file("report"); }
  static std::string text(const std::string& name) { return readFile(folder() / name); }
  static std::size_t column(const std::vector<std::vector<std::string>>& rows, const std::string& name) {
    return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
  }

  static ScratchFolder* scratch_;
  static ProgramRun* run_;
};

ScratchFolder* QuickReport::scratch_ = nullptr;
ProgramRun* QuickReport::run_ = nullptr;

TEST_F(QuickReport, KeepsEveryPromise) {
  EXPECT_EQ(run_->status, 0) << run_->messages;
  EXPECT_EQ(run_->messages, "") << "no progress in a pipe";
  EXPECT_THAT(run_->output, HasSubstr("checks of the promised formulas passed"));
  EXPECT_THAT(run_->output, Not(HasSubstr("WRONG")));
  const auto rows = parseCsv(text("verdicts.csv"));
  std::size_t promised = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].at(column(rows, "promised")) == "true") {
      ++promised;
      EXPECT_EQ(rows[i].at(column(rows, "passed")), "true") << rows[i][0] << ", " << rows[i][3] << ", " << rows[i][4];
    }
  }
  EXPECT_GT(promised, 200U);
}

TEST_F(QuickReport, IsAllThere) {
  std::size_t plots = 0;
  for (const auto& entry : fs::directory_iterator(folder() / "plots")) {
    ++plots;
    EXPECT_THAT(readFile(entry.path()), HasSubstr("</svg>")) << entry.path();
  }
  EXPECT_EQ(plots, 10U);
  EXPECT_THAT(text("accuracy.md"), HasSubstr("./run report --effort quick"));
  EXPECT_EQ(scratch_->fileCount(), 1U) << "something was left beside the report";
  const nlohmann::json run = nlohmann::json::parse(text("run.json"));
  for (const char* field : {"command", "configuration", "seed", "version", "compiler", "machine", "wall_seconds"}) {
    EXPECT_TRUE(run.contains(field)) << field;
  }
}

TEST_F(QuickReport, PageStandsByItself) {
  const std::string page = text("index.html");
  EXPECT_EQ(unbalancedTag(page), "");
  for (const char* outside : {"http://", "https://", "<script", "<link", "<img", "src=", "@import"}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
  for (const char* inside :
       {"<svg", "./run evaluate -", "./run bench", "id=\"errata\"", "Equation (19)", "Section 4.1"}) {
    EXPECT_THAT(page, HasSubstr(inside));
  }
}

TEST_F(QuickReport, HoldsFigure5AndLinksIt) {
  EXPECT_THAT(text("index.html"), HasSubstr("<a href=\"figure5/index.html\">"));
  const std::string page = text("figure5/index.html");
  EXPECT_EQ(unbalancedTag(page), "");
  EXPECT_THAT(page, HasSubstr("64 x 64 receivers"));
  EXPECT_EQ(nlohmann::json::parse(text("figure5/run.json")).at("configuration").at("resolution"),
            nlohmann::json({64, 64}));
  EXPECT_TRUE(fs::exists(folder() / "figure5" / "maps.exr"));
}

TEST_F(QuickReport, HoldsTheEstimatorsFigures) {
  const std::string page = text("index.html");
  EXPECT_THAT(page, HasSubstr("<a href=\"#estimators\">"));
  EXPECT_THAT(page, HasSubstr("id=\"estimators\""));
  for (const char* figure : {"figure5_sampled", "figure6"}) {
    EXPECT_THAT(page, HasSubstr("<a href=\"" + std::string(figure) + "/index.html\">"));
    EXPECT_EQ(unbalancedTag(text(std::string(figure) + "/index.html")), "") << figure;
    EXPECT_TRUE(fs::exists(folder() / figure / "maps.exr")) << figure;
    EXPECT_TRUE(fs::exists(folder() / figure / "figure.png")) << figure;
  }
  EXPECT_EQ(nlohmann::json::parse(text("figure5_sampled/run.json")).at("configuration").at("shape"),
            nlohmann::json({64, 64}));
  for (const char* scene : {"figure5", "black_square_in_box"}) {
    for (const char* quantity : {"gradient", "hessian"}) {
      EXPECT_TRUE(fs::exists(folder() / "figure6" / "plots" / (std::string(scene) + '_' + quantity + ".svg")));
    }
  }
  EXPECT_THAT(page, HasSubstr("Error of the tangential Hessian against rays, black_square_in_box.json"));
}

/// "0.0012" as on the page.
std::string twoDigits(double number) {
  std::array<char, 24> digits{};
  std::snprintf(digits.data(), digits.size(), "%.2g", number);
  return digits.data();
}

TEST_F(QuickReport, HasADigestOfTheAtlas) {
  const std::string page = text("index.html");
  EXPECT_THAT(page, HasSubstr("<a href=\"#atlas\">"));
  EXPECT_THAT(page, HasSubstr("<a href=\"atlas/index.html\">"));
  EXPECT_TRUE(fs::exists(folder() / "atlas" / "size_grazing_hessian.png"));
  const nlohmann::json regions = nlohmann::json::parse(text("atlas/regions.json"));
  EXPECT_GT(regions.size(), 1000U);
  // Every region of the Hessian is on the page, as in the table.
  const auto rows = parseCsv(text("atlas/regions.csv"));
  std::size_t found = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].at(column(rows, "quantity")) != "Hessian") continue;
    EXPECT_THAT(page, HasSubstr(escaped(rows[i].at(column(rows, "safe_where")))));
    ++found;
  }
  EXPECT_EQ(3 * found, regions.size());
}

// What the page says of estimators is what its table says.
TEST_F(QuickReport, TellsWhichEstimatorIsBest) {
  const std::string page = text("index.html");
  std::set<std::string> scenes;
  std::map<std::string, nlohmann::json> best;
  std::size_t orders = 0;
  for (const nlohmann::json& row : nlohmann::json::parse(text("estimators.json"))) {
    const std::string place = row.at("scene").get<std::string>() + row.at("quantity").get<std::string>();
    scenes.insert(row.at("scene"));
    const double median = row.at("median");
    const std::string cell =
        twoDigits(median) + ", " + twoDigits(row.at("percentile_99")) + ", " + twoDigits(row.at("rms"));
    EXPECT_THAT(page, HasSubstr(cell)) << row;
    EXPECT_GE(row.at("percentile_99").get<double>(), median) << row;
    if (!best.contains(place) || median < best[place].at("median")) best[place] = row;
    if (row.at("order").is_number()) ++orders;
  }
  EXPECT_EQ(scenes, (std::set<std::string>{"figure5.json", "black_square_in_box.json"}));
  EXPECT_EQ(best.size(), 4U);
  EXPECT_GE(orders, 24U);
  for (const auto& [place, row] : best) {
    EXPECT_EQ(row.at("estimator"), "discontinuity") << place;
    EXPECT_THAT(page, HasSubstr("is that of " + row.at("estimator").get<std::string>() + " (" +
                                twoDigits(row.at("median")) + ';'));
  }
  EXPECT_THAT(page, HasSubstr("Every estimator that claims to give 0 does."));
}

TEST_F(QuickReport, ErrataAreBorneOut) {
  const auto rows = parseCsv(text("errata.csv"));
  std::set<std::string> equations;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto number = [&](const char* name) { return std::stod(rows[i].at(column(rows, name))); };
    equations.insert(rows[i][0]);
    EXPECT_EQ(rows[i].at(column(rows, "confirmed")), "true") << rows[i][0];
    EXPECT_LE(number("corrected_largest"), 1e-12) << rows[i][0];
    EXPECT_GE(number("printed_largest"), 0.1) << rows[i][0];
  }
  EXPECT_EQ(equations.size(), 8U);
}

TEST_F(QuickReport, ShowsWhatFilledGapsLoseInEveryFamily) {
  std::map<std::string, std::size_t> all;
  std::map<std::string, std::size_t> large;
  std::size_t without_vertices = 0;
  const auto rows = parseCsv(text("gap_filling.csv"));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::size_t scenes = std::stoul(rows[i].at(column(rows, "scenes")));
    if (rows[i].at(column(rows, "apparent_vertices")) == "false") {
      without_vertices += scenes;
      continue;
    }
    all[rows[i][0]] += scenes;
    if (std::stod(rows[i].at(column(rows, "from"))) >= 0.1) large[rows[i][0]] += scenes;
  }
  EXPECT_EQ(all.size(), 10U);
  std::size_t sum = 0;
  for (const auto& [family, scenes] : all) {
    EXPECT_GE(scenes, 10U) << family;
    sum += scenes;
  }
  // Without the motion of apparent vertices both Hessians were the same.
  EXPECT_GT(large["tilted screens"], all["tilted screens"] / 3);
  const std::string page = text("index.html");
  EXPECT_THAT(page, HasSubstr("id=\"gap-filling\""));
  EXPECT_THAT(page, HasSubstr("scenes by error of the gap-filled Hessian"));
  EXPECT_THAT(page, HasSubstr("Of the other " + countText(sum) + " half lose at least"));
  EXPECT_THAT(page, HasSubstr(countText(without_vertices) + " have no apparent vertex"));
}

// A researcher's scripts read them by name.
TEST_F(QuickReport, TablesHaveTheirColumns) {
  EXPECT_THAT(parseCsv(text("verdicts.csv"))[0],
              testing::ElementsAre("formula", "promised", "quantity", "check", "family", "inputs", "peak", "rms",
                                   "tolerance", "uncertainty", "passed", "rule", "worst_input", "expected", "actual"));
  EXPECT_THAT(parseCsv(text("sweeps.csv"))[0],
              testing::ElementsAre("sweep", "formula", "quantity", "size", "median", "peak", "bound"));
  EXPECT_THAT(parseCsv(text("errata.csv"))[0],
              testing::ElementsAre("equation", "subject", "quantity", "oracle", "inputs", "printed_smallest",
                                   "printed_largest", "corrected_largest", "allowance", "confirmed"));
  EXPECT_THAT(parseCsv(text("gap_filling.csv"))[0],
              testing::ElementsAre("family", "apparent_vertices", "from", "to", "scenes"));
  EXPECT_THAT(parseCsv(text("bound_tightness.csv"))[0],
              testing::ElementsAre("evaluator", "inputs", "family", "quantity", "values", "exact", "unbounded", "least",
                                   "median", "percentile_99", "largest"));
}

TEST_F(QuickReport, MeasuresBoundsOfEveryEvaluatorAndFamily) {
  const auto rows = parseCsv(text("bound_tightness.csv"));
  std::map<std::string, std::set<std::string>> families;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto number = [&](const char* name) { return std::stod(rows[i].at(column(rows, name))); };
    families[rows[i][0] + ", " + rows[i][1]].insert(rows[i].at(column(rows, "family")));
    if (number("values") == number("exact") + number("unbounded")) continue;
    EXPECT_GE(number("least"), 1.0) << rows[i][0] << ' ' << rows[i][2] << ' ' << rows[i][3];
    EXPECT_LE(number("least"), number("median"));
    EXPECT_LE(number("median"), number("percentile_99"));
    EXPECT_LE(number("percentile_99"), number("largest"));
  }
  EXPECT_EQ(families["production, polygons"].size(), 13U);
  EXPECT_EQ(families["production, scenes"].size(), 10U);
  EXPECT_EQ(families["production, segments"].size(), 6U);
  EXPECT_EQ(families["certified, double, polygons"].size(), 13U);
  EXPECT_EQ(families["certified to 1e-12, scenes"].size(), 10U);
  EXPECT_THAT(text("index.html"), HasSubstr("every bound holds"));
}

// Every oracle that the report is trusted for; a suite that lost one would still pass.
TEST_F(QuickReport, NoOracleIsMissing) {
  const auto rows = parseCsv(text("verdicts.csv"));
  std::set<std::string> checks;
  std::set<std::string> catalogue_numbers;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i][0] == "production") {
      const std::string check = rows[i].at(column(rows, "check"));
      checks.insert(check);
      if (check.starts_with("closed form ") && check != "closed form " + rows[i].at(column(rows, "family"))) {
        catalogue_numbers.insert(check);
      }
    }
  }
  EXPECT_GE(catalogue_numbers.size(), 10U);
  EXPECT_THAT(checks, testing::IsSupersetOf({"area-integral enclosure", "reference data", "multiprecision",
                                             "nested Jets on F", "Jets on the gradient", "differences at 200 digits",
                                             "differences of its own form factor", "differences of its own gradient",
                                             "claimed bound", "closure", "additivity", "scaling", "rotation", "mirror",
                                             "reversal", "reciprocity", "symmetry", "trace"}));
}

TEST_F(QuickReport, TablesAgree) {
  for (const std::string& table : kTables) {
    const auto rows = parseCsv(text(table + ".csv"));
    const nlohmann::json objects = nlohmann::json::parse(text(table + ".json"));
    ASSERT_GT(rows.size(), 1U) << table;
    EXPECT_EQ(objects.size(), rows.size() - 1) << table;
    for (const auto& row : rows) {
      EXPECT_EQ(row.size(), rows[0].size()) << table;
    }
    for (const std::string& name : rows[0]) {
      EXPECT_TRUE(objects[0].contains(name)) << table << ": " << name;
    }
  }
}

TEST_F(QuickReport, WorstInputsCanBeEvaluated) {
  const auto rows = parseCsv(text("verdicts.csv"));
  std::string lines;
  std::size_t count = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].at(column(rows, "promised")) == "true") {
      lines += rows[i].at(column(rows, "worst_input")) + '\n';
      ++count;
    }
  }
  const ProgramRun evaluation = runProgram({"evaluate", "-"}, lines);
  EXPECT_EQ(evaluation.status, 0) << evaluation.messages;
  EXPECT_EQ(jsonLines(evaluation.output).size(), count);
  EXPECT_THAT(evaluation.output, Not(HasSubstr("\"error\":")));
}

TEST_F(QuickReport, SurvivesARunThatFails) {
  const std::string page = text("index.html");
  const ProgramRun run =
      runProgram({"report", "--output", folder().string(), "--effort", "quick", "--reference", "nowhere"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, HasSubstr("nowhere"));
  EXPECT_EQ(text("index.html"), page);
  EXPECT_EQ(scratch_->fileCount(), 1U) << "the failed run left something behind";
}

TEST_F(QuickReport, SurvivesARunThatIsKilled) {
  const ScratchFolder scratch;
  fs::copy(folder(), scratch.file("report"), fs::copy_options::recursive);
  const std::string command = "timeout --signal=KILL 1 \"$IRRADIFF_PROGRAM\" report --effort quick --output " +
                              scratch.file("report").string() + " >/dev/null 2>&1";
  EXPECT_NE(std::system(command.c_str()), 0) << "the run was meant to be killed";
  EXPECT_EQ(readFile(scratch.file("report") / "index.html"), text("index.html"));
  EXPECT_EQ(readFile(scratch.file("report") / "run.json"), text("run.json"));
}

/// The lines of a table of the report that have not to do with production's Hessian.
std::string withoutProductionHessian(const std::string& csv) {
  std::string kept;
  const auto rows = parseCsv(csv);
  for (const std::vector<std::string>& row : rows) {
    const auto names = [&](const char* name) { return std::find(row.begin(), row.end(), name) != row.end(); };
    if ((names("production") && names("gradient")) || names("flatland")) {
      for (const std::string& cell : row) {
        kept += cell + '\n';
      }
    }
  }
  return kept;
}

// The bad twin: a production path whose Hessian is one percent off. It is made on one thread, so that what it has in
// common with the program's report, made on two, must be the same to the last digit.
TEST_F(QuickReport, OfABrokenFormulaIsWrongAndTheSameElsewhere) {
  ReportedFormulas formulas = libraryFormulas();
  formulas.comparisons.clear();
  const auto hessian = formulas.production.hessian;
  formulas.production.hessian = [hessian](const Configuration& c) -> Eigen::Matrix3d { return 1.01 * hessian(c); };
  formulas.bounded = {{"production",
                       [](const Configuration& c) {
                         PolygonEvaluation evaluation = evaluatePolygon(c.polygon, 0, c.receiver);
                         evaluation.bounds.hessian *= 1e-3;
                         return evaluation;
                       },
                       {},
                       {}}};
  ReportOptions options;
  options.effort = Effort::kQuick;
  options.threads = 1;
  options.reference_folder = "data/reference";
  const AccuracyReport report = makeReport(formulas, options);
  EXPECT_EQ(exitStatusOf(report), 1);
  for (const Verdict& broken : brokenPromises(report)) {
    EXPECT_EQ(broken.quantity, Quantity::kHessian) << describe(broken);
  }
  // So are bounds of the Hessian that are a thousandth of what they should be.
  const std::vector<BoundTightness> broken_bounds = brokenBounds(report);
  EXPECT_EQ(broken_bounds.size(), 13U);
  for (const BoundTightness& broken : broken_bounds) EXPECT_EQ(broken.quantity, Quantity::kHessian) << broken.family;

  const ScratchFolder scratch;
  ResultFolder folder(scratch.file("report"), "report");
  writeReport(report, recordOfThisProgram(), folder);
  folder.commit();
  const auto brokenText = [&](const char* name) { return readFile(scratch.file("report") / name); };
  const std::string page = brokenText("index.html");
  const std::string summary = page.substr(0, page.find("id=\"legend\""));
  EXPECT_THAT(summary, HasSubstr("class=\"verdict wrong\""));
  EXPECT_THAT(summary, HasSubstr("WRONG: "));
  EXPECT_THAT(summary, HasSubstr("production: hessian: WRONG"));
  EXPECT_EQ(unbalancedTag(page), "");
  EXPECT_THAT(brokenText("accuracy.md"), HasSubstr("WRONG: "));
  EXPECT_THAT(page, Not(HasSubstr("Further pages"))) << "none was given";

  EXPECT_EQ(brokenText("errata.csv"), text("errata.csv"));
  EXPECT_EQ(brokenText("gap_filling.csv"), text("gap_filling.csv"));
  for (const char* table : {"verdicts.csv", "sweeps.csv"}) {
    const std::string expected = withoutProductionHessian(text(table));
    EXPECT_GT(expected.size(), 10000U) << table;
    EXPECT_EQ(withoutProductionHessian(brokenText(table)), expected) << table;
  }
}

TEST(ReportCommand, RefusesAFolderThatIsNoReport) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.file("thesis"));
  writeFile(scratch.file("thesis") / "chapter.tex", "years of work");
  const ProgramRun run = runProgram({"report", "--output", scratch.file("thesis").string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, HasSubstr("is not a report of irradiff"));
  EXPECT_EQ(readFile(scratch.file("thesis") / "chapter.tex"), "years of work");
}

TEST(ReportCommand, NamesWrongArguments) {
  EXPECT_EQ(runProgram({"report"}).status, 2);
  const ProgramRun run = runProgram({"report", "--output", "never-made", "--effort", "heroic"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, HasSubstr("heroic"));
  EXPECT_FALSE(fs::exists("never-made"));
}

}  // namespace
}  // namespace irradiff
