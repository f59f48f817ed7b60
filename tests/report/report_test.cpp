#include "tests/cli/program_run.h"
#include "tests/report/report_text.h"
#include "verification/report/accuracy_report.h"
#include "verification/report/run_record.h"
#include "verification/report/write_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::vector<std::string> kTables = {"verdicts", "sweeps", "errata"};

/// One quick report by the program, shared by the tests.
class QuickReport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchFolder;
    run_ = new ProgramRun(runProgram({"report", "--output", folder().string(), "--effort", "quick"}));
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

TEST_F(QuickReport, DoesNotDependOnThreads) {
  const ScratchFolder scratch;
  const fs::path other = scratch.file("report");
  const ProgramRun run = runProgram({"report", "--output", other.string(), "--effort", "quick", "--threads", "1"});
  ASSERT_EQ(run.status, 0) << run.messages;
  for (const std::string& table : kTables) {
    EXPECT_EQ(readFile(other / (table + ".csv")), text(table + ".csv"));
  }
  EXPECT_EQ(readFile(other / "accuracy.md"), text("accuracy.md"));
  EXPECT_EQ(readFile(other / "plots/edge_over_distance_hessian.svg"), text("plots/edge_over_distance_hessian.svg"));
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

// The bad twin: a production path whose Hessian is one percent off.
TEST(BrokenFormula, IsReportedAsWrong) {
  ReportedFormulas formulas = libraryFormulas();
  formulas.comparisons.clear();
  const auto hessian = formulas.production.hessian;
  formulas.production.hessian = [hessian](const Configuration& c) -> Eigen::Matrix3d { return 1.01 * hessian(c); };
  ReportOptions options;
  options.effort = Effort::kQuick;
  options.threads = 2;
  options.reference_folder = "data/reference";
  const AccuracyReport report = makeReport(formulas, options);
  EXPECT_EQ(exitStatusOf(report), 1);
  for (const Verdict& broken : brokenPromises(report)) {
    EXPECT_EQ(broken.quantity, Quantity::kHessian) << describe(broken);
  }

  const ScratchFolder scratch;
  ReportFolder folder(scratch.file("report"));
  writeReport(report, recordOfThisProgram(), folder);
  folder.commit();
  const std::string page = readFile(scratch.file("report") / "index.html");
  const std::string summary = page.substr(0, page.find("id=\"legend\""));
  EXPECT_THAT(summary, HasSubstr("class=\"verdict wrong\""));
  EXPECT_THAT(summary, HasSubstr("WRONG: "));
  EXPECT_THAT(summary, HasSubstr("production: hessian: WRONG"));
  EXPECT_EQ(unbalancedTag(page), "");
  EXPECT_THAT(readFile(scratch.file("report") / "accuracy.md"), HasSubstr("WRONG: "));
}

}  // namespace
}  // namespace irradiff
