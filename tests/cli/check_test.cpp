// `irradiff check`: programs of users, asked through pipes.

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

ProgramRun checked(const std::string& command, const std::string& tolerance = "1e-12") {
  return runProgram({"check", command, "--inputs", "3", "--tolerance", tolerance});
}

/// The program itself as a user's, its answers edited.
std::string evaluateThrough(const std::string& filter) {
  const std::string program = std::getenv("IRRADIFF_PROGRAM");
  return "'" + program + "' evaluate - | " + filter;
}

TEST(Check, AcceptsIrradiffItself) {
  const ProgramRun run = checked(evaluateThrough("cat"), "2e-14");
  EXPECT_EQ(run.status, 0) << run.output << run.messages;
  EXPECT_THAT(run.output, AllOf(HasSubstr("the program: all "), HasSubstr("checks passed"), HasSubstr("reciprocity"),
                                HasSubstr("differences of its own gradient"), Not(HasSubstr("WRONG"))));
}

TEST(Check, RejectsAProgramWhoseAxesAreExchanged) {
  const ProgramRun run = checked(evaluateThrough(R"(sed -u -E 's/"gradient":\[([^,]*),([^,]*),/"gradient":[\2,\1,/')"));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("the program: gradient: WRONG on 3 of 3 inputs"),
                                HasSubstr("come out as (y, x, z)"), Not(HasSubstr("rotational gradient: WRONG"))));
}

TEST(Check, ChecksWhatTheProgramAnswersAndNoMore) {
  const ProgramRun run = checked(R"(while read -r scene; do echo '{"results": [{"gradient": [1,2,3]}]}'; done)");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output,
              AllOf(HasSubstr("gradient: WRONG"), Not(HasSubstr("hessian")), Not(HasSubstr("form factor"))));
}

TEST(Check, SaysWhatIsWrongWithTheAnswers) {
  const auto messageOf = [](const std::string& command) {
    const ProgramRun run = checked(command);
    EXPECT_EQ(run.status, 1) << command;
    return run.messages + run.output;
  };
  EXPECT_THAT(messageOf("true"), HasSubstr("the program `true` has ended"));
  EXPECT_THAT(messageOf("cat"), HasSubstr("must answer a line"));
  EXPECT_THAT(messageOf("no_such_program 2>/dev/null"), HasSubstr("has ended"));
  EXPECT_THAT(messageOf(R"(while read -r scene; do echo '{"error": "not today"}'; done)"), HasSubstr("not today"));
  EXPECT_THAT(messageOf(R"(while read -r scene; do echo '{"results": [{"gradient": [1,2]}]}'; done)"),
              HasSubstr("\"gradient\" is [1,2], must be 3 numbers"));
  EXPECT_THAT(messageOf(R"(while read -r scene; do echo '{"results": [{}]}'; done)"),
              HasSubstr("none of the quantities"));
  // Ends in the middle.
  EXPECT_THAT(messageOf(R"(read -r scene; echo '{"results": [{"gradient": [1,2,3]}]}')"), HasSubstr("has ended"));
}

TEST(Check, RefusesAWrongCall) {
  EXPECT_EQ(runProgram({"check"}).status, 2);
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--inputs", "0"},
                                                                                      {"--inputs", "1.5"},
                                                                                      {"--tolerance", "-1"},
                                                                                      {"--tolerance", "0"},
                                                                                      {"--tolerance", "nan"},
                                                                                      {"--seed", "-1"},
                                                                                      {"--seed", "x"}}) {
    const ProgramRun run = runProgram({"check", "cat", option, value});
    EXPECT_EQ(run.status, 2) << option << ' ' << value;
    EXPECT_THAT(run.messages, HasSubstr(option + ": \"" + value + "\" must be"));
  }
}

}  // namespace
}  // namespace irradiff
