// `irradiff figure` with estimators as a black box: what it writes, that nothing depends on threads, and that a run
// that was killed goes on where it was.

#include "tests/cli/program_run.h"
#include "tests/cli/running_program.h"
#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A lamp and a screen that hides some of it, over a grid of 8 x 6 cells.
constexpr const char* kScene =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "A lamp behind a screen.",
    "polygons": [{"name": "lamp", "radiance": 2.5, "vertices": [[0.1,0.2,1], [0.9,0.3,1], [0.8,0.7,1], [0.2,0.9,1]]},
                 {"name": "screen", "radiance": 0, "vertices": [[0.3,0.3,0.5], [0.6,0.3,0.5], [0.6,0.7,0.5]]}],
    "grid": {"origin": [0,0,0], "u": [1,0,0], "v": [0,0.75,0], "resolution": [8,6], "normal": [0,0,1]}})";

class SampledFigure : public testing::Test {
 protected:
  SampledFigure() { writeFile(scratch_.file("scene.json"), kScene); }

  std::string path(const std::string& name) const { return scratch_.file(name).string(); }

  std::vector<std::string> call(const std::string& number, const std::string& output,
                                const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"figure", number, "--scene", path("scene.json"), "--output", path(output)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }

  ProgramRun figure(const std::string& output, const std::vector<std::string>& options) const {
    return runProgram(call("5", output, options));
  }

  /// All files of a figure but those that tell when and how it was made.
  std::map<std::string, std::string> results(const std::string& output) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(scratch_.file(output))) {
      const std::string name = fs::relative(entry.path(), scratch_.file(output)).string();
      if (entry.is_regular_file() && name != "run.json" && name != "index.html") files[name] = readFile(entry.path());
    }
    return files;
  }

  ScratchFolder scratch_;
};

TEST_F(SampledFigure, WritesMapsPicturesErrorsPageAndRecord) {
  const ProgramRun run = figure("out", {"--rays", "70", "--seed", "5"});
  ASSERT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.messages, "") << "no progress in a pipe";
  EXPECT_EQ(scratch_.fileCount(), 2U) << "the scene and the figure, nothing aside";
  const auto files = results("out");
  for (const char* name : {"maps.exr", "figure.png", "scene.png", "gradient.analytic.png", "gradient.ward-heckbert.png",
                           "gradient.triangulated.difference.png", "eigenvalues.radiometric.png",
                           "hessian.triangulated-closed.png", "errors.csv", "errors.json"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
  EXPECT_FALSE(files.contains("hessian.ward-heckbert.png")) << "it has no Hessian";
  const Json record = Json::parse(readFile(scratch_.file("out") / "run.json"));
  EXPECT_EQ(record.at("seed"), 5);
  EXPECT_EQ(record.at("configuration").at("shape"), Json({8, 8})) << "70 rays rounded down to a square";
  EXPECT_THAT(readFile(scratch_.file("out") / "index.html"),
              AllOf(HasSubstr("A lamp behind a screen."), HasSubstr("data-values"), HasSubstr("64 rays")));
}

// The errors that are told are those of the maps, which are those of `irradiff evaluate`.
TEST_F(SampledFigure, TellsTheErrorsOfItsMaps) {
  ASSERT_EQ(figure("out", {"--rays", "64"}).status, 0);
  const ReadExr maps = readExr(readFile(scratch_.file("out") / "maps.exr"));
  const Json exact = Json::parse(runProgram({"evaluate", path("scene.json")}).output).at("results");
  std::vector<double> errors;
  for (std::size_t i = 0; i < 48; ++i) {
    const std::size_t place = (5 - i / 8) * 8 + i % 8;
    const double x = exact[i]["gradient"][0];
    const double y = exact[i]["gradient"][1];
    const double dx = maps.channels.at("triangulated.gradient.x")[place] - x;
    const double dy = maps.channels.at("triangulated.gradient.y")[place] - y;
    errors.push_back(std::max(std::abs(dx), std::abs(dy)) / std::max(std::abs(x), std::abs(y)));
    EXPECT_NEAR(maps.channels.at("triangulated.error.gradient")[place], errors.back(), 1e-6 * (1.0 + errors.back()));
  }
  std::ranges::sort(errors);
  bool is_told = false;
  for (const Json& row : Json::parse(readFile(scratch_.file("out") / "errors.json"))) {
    if (row.at("quantity") != "gradient" || row.at("estimator") != "triangulated") continue;
    is_told = true;
    EXPECT_EQ(row.at("compared"), 48);
    EXPECT_NEAR(row.at("median").get<double>(), errors[23], 1e-6);
    EXPECT_NEAR(row.at("percentile_99").get<double>(), errors[47], 1e-6);
  }
  EXPECT_TRUE(is_told);
}

TEST_F(SampledFigure, IsTheSameForAnyNumberOfThreads) {
  ASSERT_EQ(figure("one", {"--rays", "64", "--threads", "1"}).status, 0);
  ASSERT_EQ(figure("three", {"--rays", "64", "--threads", "3"}).status, 0);
  ASSERT_EQ(figure("other", {"--rays", "64", "--seed", "2"}).status, 0);
  EXPECT_TRUE(results("one") == results("three"));
  const auto one = results("one");
  const auto other = results("other");
  EXPECT_FALSE(one.at("maps.exr") == other.at("maps.exr"));
  EXPECT_TRUE(one.at("gradient.analytic.png") == other.at("gradient.analytic.png"));
}

TEST_F(SampledFigure, DrawsFigure6) {
  const ProgramRun run = runProgram(call("6", "out", {"--effort", "quick", "--resolution", "6"}));
  ASSERT_EQ(run.status, 0) << run.messages;
  const auto files = results("out");
  for (const char* name : {"maps.exr", "figure.png", "gradient.analytic.png", "rays100.gradient.ward-heckbert.png",
                           "rays4356.gradient.triangulated.png", "curves.csv", "orders.csv", "plots/scene_gradient.svg",
                           "plots/scene_hessian.svg", "plots/black_square_in_box_gradient.svg"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
  // Enough rays help whoever is not wrong altogether.
  std::istringstream lines(files.at("curves.csv"));
  std::map<std::string, double> median;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    ASSERT_EQ(row.size(), 10U) << line;
    if (row[0] == "scene.json" && row[1] == "gradient" && row[2] == "triangulated") median[row[3]] = std::stod(row[7]);
  }
  EXPECT_LT(median.at("4096"), median.at("64"));
  EXPECT_THAT(readFile(scratch_.file("out") / "index.html"), AllOf(HasSubstr("<svg"), HasSubstr("order in 1/N")));
}

TEST_F(SampledFigure, GoesOnAfterItWasKilled) {
  const std::vector<std::string> options{"--rays", "4096", "--resolution", "48", "--threads", "1"};
  const fs::path unfinished = scratch_.file("out.part");
  {
    RunningProgram run(call("5", "out", options));
    while (tilesIn(unfinished) < 3) {
      ASSERT_TRUE(run.isRunning()) << "it ended before it could be killed";
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    run.pause();
    // While it is there, nobody else may work there.
    const ProgramRun second = figure("out", options);
    EXPECT_EQ(second.status, 2);
    EXPECT_THAT(second.messages, AllOf(HasSubstr("--output"), HasSubstr("another run")));
    run.kill();
  }
  ASSERT_FALSE(fs::exists(scratch_.file("out")));
  const std::size_t finished = tilesIn(unfinished);
  ASSERT_GE(finished, 3U);
  ASSERT_LT(finished, 36U) << "it had finished";
  EXPECT_EQ(scratch_.fileCount(), 2U) << "the scene and the finished rows, no half of a figure";
  ASSERT_EQ(figure("out", options).status, 0);
  EXPECT_FALSE(fs::exists(unfinished));
  ASSERT_EQ(figure("whole", options).status, 0);
  EXPECT_TRUE(results("out") == results("whole"));
}

TEST_F(SampledFigure, StartsAnewForAnotherConfiguration) {
  ASSERT_EQ(figure("expected", {"--rays", "16", "--seed", "2"}).status, 0);
  // What another call left: rows that would fit.
  {
    RunningProgram run(call("5", "out", {"--rays", "16384", "--resolution", "48", "--threads", "1"}));
    while (tilesIn(scratch_.file("out.part")) < 1) {
      ASSERT_TRUE(run.isRunning());
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    run.kill();
  }
  ASSERT_EQ(figure("out", {"--rays", "16", "--seed", "2"}).status, 0);
  EXPECT_TRUE(results("out") == results("expected"));
}

TEST_F(SampledFigure, LeavesAFolderOfOthersAlone) {
  fs::create_directory(scratch_.file("out.part"));
  writeFile(scratch_.file("out.part") / "thesis.txt", "three years");
  const ProgramRun run = figure("out", {"--rays", "16"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("--output"), HasSubstr("out.part"), HasSubstr("something else")));
  EXPECT_TRUE(fs::exists(scratch_.file("out.part") / "thesis.txt"));
}

}  // namespace
}  // namespace irradiff
