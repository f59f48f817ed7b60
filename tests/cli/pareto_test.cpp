// `irradiff pareto` as a black box: what it writes, what of it does not depend on the machine, and what it says to a
// wrong call.

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class ParetoCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.file(name).string(); }

  ProgramRun pareto(const std::string& folder, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"pareto", "--output", path(folder)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runProgram(arguments);
  }

  template <class Matcher>
  void expectRefusal(const ProgramRun& run, const Matcher& message) const {
    EXPECT_EQ(run.status, 2) << run.messages;
    EXPECT_THAT(run.messages, message);
    EXPECT_EQ(scratch_.fileCount(), 0U);
  }

  ScratchFolder scratch_;
};

const std::vector<std::string> kQuick{"--effort", "quick", "--family", "generic", "--family", "size"};

TEST_F(ParetoCommand, WritesPlotTablesPageAndRecord) {
  const ProgramRun run = pareto("out", kQuick);
  ASSERT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.messages, "") << "no progress in a pipe";
  EXPECT_THAT(run.output, HasSubstr("regret of choosing a rule"));
  EXPECT_THAT(run.output, HasSubstr((fs::weakly_canonical(scratch_.file("out")) / "index.html").string()));
  for (const char* table : {"trade", "errors", "regret", "estimators"}) {
    EXPECT_FALSE(Json::parse(readFile(scratch_.file("out") / (std::string(table) + ".json"))).empty()) << table;
    EXPECT_FALSE(readFile(scratch_.file("out") / (std::string(table) + ".csv")).empty()) << table;
  }
  EXPECT_THAT(readFile(scratch_.file("out") / "pareto.svg"), HasSubstr("</svg>"));
  const Json record = Json::parse(readFile(scratch_.file("out") / "run.json"));
  EXPECT_EQ(record.at("command").at(1), "pareto");
  EXPECT_EQ(record.at("configuration").at("families"), (Json{"generic", "size"}));
  EXPECT_EQ(record.at("regret").size(), 8U);
  for (const Json& row : record.at("regret")) EXPECT_EQ(row.at("broken"), 0);
}

TEST_F(ParetoCommand, FindsTheSameErrorsAgain) {
  ASSERT_EQ(pareto("one", kQuick).status, 0);
  ASSERT_EQ(pareto("two", kQuick).status, 0);
  const std::string errors = readFile(scratch_.file("one") / "errors.csv");
  EXPECT_EQ(errors, readFile(scratch_.file("two") / "errors.csv"));
  std::vector<std::string> other = kQuick;
  other.insert(other.end(), {"--seed", "2"});
  ASSERT_EQ(pareto("two", other).status, 0) << "earlier results are replaced";
  EXPECT_NE(errors, readFile(scratch_.file("two") / "errors.csv"));
}

TEST_F(ParetoCommand, RefusesWrongCalls) {
  expectRefusal(pareto("out", {"--family", "nonsense"}),
                AllOf(HasSubstr("--family"), HasSubstr("\"nonsense\""), HasSubstr("well-conditioned")));
  expectRefusal(pareto("out", {"--effort", "huge"}), HasSubstr("--effort: \"huge\" must be quick, standard or full"));
  expectRefusal(pareto("out", {"--seed", "-1"}), AllOf(HasSubstr("--seed"), HasSubstr("-1")));
  expectRefusal(runProgram({"pareto"}), HasSubstr("--output"));
}

TEST_F(ParetoCommand, LeavesForeignFoldersAlone) {
  fs::create_directory(scratch_.file("mine"));
  writeFile(path("mine/notes.txt"), "mine");
  const ProgramRun run = pareto("mine", kQuick);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("--output"), HasSubstr("is not a pareto of irradiff")));
  EXPECT_EQ(readFile(path("mine/notes.txt")), "mine");
}

}  // namespace
}  // namespace irradiff
