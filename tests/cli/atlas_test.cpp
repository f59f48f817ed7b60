// `irradiff atlas` as a black box: what it writes, that it is whole or not there, that a killed run goes on, and what
// it says to a wrong call.

#include "tests/cli/program_run.h"
#include "tests/cli/running_program.h"
#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class AtlasCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.file(name).string(); }

  static std::vector<std::string> call(const std::string& output, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"atlas", "--output", output, "--effort", "quick"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }

  /// Every file but those that say how it was made.
  std::map<std::string, std::string> results(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(scratch_.file(folder))) {
      const std::string name = entry.path().filename();
      if (name != "run.json" && name != "index.html" && name != "atlas.md") files[name] = readFile(entry.path());
    }
    return files;
  }

  ScratchFolder scratch_;
};

TEST_F(AtlasCommand, WritesMapsRegionsPageAndRecordAndGoesOnAfterItWasKilled) {
  {
    RunningProgram run(call(path("out"), {"--threads", "1"}));
    while (tilesIn(scratch_.file("out.part")) < 3) {
      ASSERT_TRUE(run.isRunning()) << "it ended before it could be killed";
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    run.kill();
  }
  EXPECT_FALSE(fs::exists(path("out"))) << "nothing half";
  const ProgramRun rest = runProgram(call(path("out"), {"--threads", "2"}));
  ASSERT_EQ(rest.status, 0) << rest.messages;
  EXPECT_EQ(rest.messages, "") << "no progress in a pipe";
  EXPECT_THAT(rest.output, AllOf(HasSubstr("inequalities"), HasSubstr(", 0 failed"), HasSubstr("index.html")));
  EXPECT_FALSE(fs::exists(path("out.part")));
  const ProgramRun whole = runProgram(call(path("whole"), {"--threads", "1"}));
  ASSERT_EQ(whole.status, 0) << whole.messages;
  EXPECT_TRUE(results("out") == results("whole")) << "bytes depend neither on threads nor on the interruption";

  const ReadExr map = readExr(readFile(scratch_.file("out") / "size_grazing.exr"));
  EXPECT_EQ(map.width, 24U);
  const std::vector<float>& in_double = map.channels.at("evaluatePolygon.double.Hessian");
  EXPECT_LT(std::ranges::max(in_double), 1e-12);
  const std::vector<float>& textbook = map.channels.at("appendix_acos.double.Hessian");
  EXPECT_EQ(textbook.front(), 1e38F) << "tiny polygons: not finite";
  EXPECT_TRUE(std::isnan(map.channels.at("area_rule.float.F").at(23 * 24))) << "below: floats hold no such angle";
  EXPECT_EQ(Json::parse(map.texts.at("axes")).at(0).at("name"), "edge/distance");
  EXPECT_GT(readPng(readFile(scratch_.file("out") / "size_grazing_hessian.png")).width, 512U);
  EXPECT_THAT(readFile(scratch_.file("out") / "index.html"), HasSubstr("Stability atlas"));
  const std::string table = readFile(scratch_.file("out") / "regions.csv");
  EXPECT_THAT(table, HasSubstr("safe_where"));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(table, '\n')),
            1 + Json::parse(readFile(scratch_.file("out") / "regions.json")).size());
  const Json record = Json::parse(readFile(scratch_.file("out") / "run.json"));
  EXPECT_EQ(record.at("command").at(1), "atlas");
  EXPECT_EQ(record.at("refuted"), 0);
}

TEST_F(AtlasCommand, NamesWrongArguments) {
  const auto expectRefusal = [&](const std::vector<std::string>& options, const auto& message) {
    const ProgramRun run = runProgram(call(path("out"), options));
    EXPECT_EQ(run.status, 2) << run.messages;
    EXPECT_THAT(run.messages, message);
    EXPECT_EQ(scratch_.fileCount(), 0U);
  };
  expectRefusal({"--effort", "great"}, HasSubstr("--effort: \"great\" must be quick, standard or full"));
  expectRefusal({"--seed", "-1"}, AllOf(HasSubstr("--seed"), HasSubstr("\"-1\" must be a whole number")));
  expectRefusal({"--seed", "1e3"}, AllOf(HasSubstr("--seed"), HasSubstr("\"1e3\" must be")));
  expectRefusal({"--threads", "0"}, AllOf(HasSubstr("--threads"), HasSubstr("whole number from 1 to 1024")));
  expectRefusal({"surplus"}, HasSubstr("surplus"));
  const ProgramRun run = runProgram({"atlas"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, HasSubstr("--output is required"));
}

TEST_F(AtlasCommand, ReplacesNothingButAnAtlas) {
  fs::create_directory(path("out"));
  writeFile(scratch_.file("out") / "thesis.txt", "three years");
  const ProgramRun run = runProgram(call(path("out"), {}));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("--output"), HasSubstr("is not an atlas of irradiff")));
  EXPECT_EQ(readFile(scratch_.file("out") / "thesis.txt"), "three years");
}

TEST_F(AtlasCommand, LeavesAFolderOfOthersAlone) {
  fs::create_directory(path("out.part"));
  writeFile(scratch_.file("out.part") / "thesis.txt", "three years");
  const ProgramRun run = runProgram(call(path("out"), {}));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("--output"), HasSubstr("out.part"), HasSubstr("something else")));
}

}  // namespace
}  // namespace irradiff
