// `irradiff figure` as a black box: what it writes, that it is whole or not there, and what it says to a wrong call.

#include "tests/cli/program_run.h"
#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// One lamp over a grid of 8 x 4 cells; nothing hides anything.
Json lampScene() {
  return Json::parse(R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "A lamp.",
    "polygons": [{"name": "lamp", "radiance": 2.5, "vertices": [[0.1,0.2,1], [0.9,0.3,1], [0.8,0.7,1], [0.2,0.9,1]]}],
    "grid": {"origin": [0,0,0], "u": [2,0,0], "v": [0,1,0], "resolution": [8,4], "normal": [0,0,1]}})");
}

class Figure : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.file(name).string(); }

  ProgramRun figure(const Json& scene, const std::vector<std::string>& options = {}) const {
    writeFile(path("scene.json"), scene.dump());
    std::vector<std::string> arguments{"figure",           "5",        "--analytic", "--scene",
                                       path("scene.json"), "--output", path("maps")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runProgram(arguments);
  }

  std::string written(const std::string& name) const { return readFile(scratch_.file("maps") / name); }

  /// The call was wrong, and nothing was written beside the scene.
  template <class Matcher>
  void expectRefusal(const ProgramRun& run, const Matcher& message) const {
    EXPECT_EQ(run.status, 2) << run.messages;
    EXPECT_THAT(run.messages, message);
    EXPECT_FALSE(fs::exists(path("maps")));
    EXPECT_LE(scratch_.fileCount(), 1U);
  }

  ScratchFolder scratch_;
};

TEST_F(Figure, WritesMapsPicturesPageAndRecord) {
  const Json scene = lampScene();
  const ProgramRun run = figure(scene);
  ASSERT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.messages, "") << "no progress in a pipe";
  EXPECT_EQ(run.output, (fs::weakly_canonical(scratch_.file("maps")) / "index.html").string() + '\n');
  EXPECT_EQ(scratch_.fileCount(), 2U) << "the scene and the figure, nothing aside";
  EXPECT_GT(readPng(written("eigenvalues.png")).width, 256U);
  EXPECT_THAT(written("index.html"), HasSubstr("A lamp."));
  const Json record = Json::parse(written("run.json"));
  EXPECT_EQ(record.at("command").at(1), "figure");
  EXPECT_TRUE(record.at("seed").is_null());
}

// The values are those that `irradiff evaluate` gives, rounded to float.
TEST_F(Figure, AgreesWithEvaluate) {
  const Json scene = lampScene();
  ASSERT_EQ(figure(scene).status, 0);
  const ReadExr maps = readExr(written("maps.exr"));
  const Json results = Json::parse(runProgram({"evaluate", path("scene.json")}).output).at("results");
  ASSERT_EQ(maps.width, 8U);
  ASSERT_EQ(maps.height, 4U);
  ASSERT_EQ(results.size(), 32U);
  for (std::size_t i = 0; i < 32; ++i) {
    const auto at = [&](const char* name) { return maps.channels.at(name)[(3 - i / 8) * 8 + i % 8]; };
    const Json& result = results[i];
    EXPECT_EQ(at("E"), result["irradiance"].get<float>());
    EXPECT_EQ(at("gradient.x"), result["gradient"][0].get<float>());
    EXPECT_EQ(at("gradient.y"), result["gradient"][1].get<float>());
    EXPECT_EQ(at("gradient.z"), result["gradient"][2].get<float>());
    EXPECT_EQ(at("hessian.xx"), result["tangential_hessian"][0][0].get<float>());
    EXPECT_EQ(at("hessian.xy"), result["tangential_hessian"][0][1].get<float>());
    EXPECT_EQ(at("hessian.yy"), result["tangential_hessian"][1][1].get<float>());
    EXPECT_EQ(at("bound.hessian"), result["error_bound"]["hessian"].get<float>());
    // Sums of eigenvalues and of their squares need none; 2^-20 is 8 roundings of a float.
    const Json& h = result["hessian"];
    double squares = 0;
    for (std::size_t a = 0; a < 9; ++a) {
      squares += std::pow(h[a / 3][a % 3].get<double>(), 2);
    }
    const double l1 = at("lambda1");
    const double l2 = at("lambda2");
    const double l3 = at("lambda3");
    const double trace = h[0][0].get<double>() + h[1][1].get<double>() + h[2][2].get<double>();
    EXPECT_GE(l1, l2);
    EXPECT_GE(l2, l3);
    EXPECT_NEAR(l1 + l2 + l3, trace, 0x1p-20 * std::sqrt(squares));
    EXPECT_NEAR(l1 * l1 + l2 * l2 + l3 * l3, squares, 0x1p-20 * squares);
  }
}

TEST_F(Figure, IsTheSameForAnyNumberOfThreads) {
  const Json scene = lampScene();
  ASSERT_EQ(figure(scene, {"--threads", "1", "--resolution", "37"}).status, 0);
  const std::string maps = written("maps.exr");
  const std::string picture = written("lambda2.png");
  ASSERT_EQ(figure(scene, {"--threads", "3", "--resolution", "37"}).status, 0) << "a figure replaces a figure";
  EXPECT_TRUE(written("maps.exr") == maps);
  EXPECT_TRUE(written("lambda2.png") == picture);
  EXPECT_EQ(readExr(maps).width, 37U);
  EXPECT_EQ(readExr(maps).height, 19U) << "half as high as wide, nearly";
  ASSERT_EQ(figure(scene, {"--resolution", "36"}).status, 0);
  EXPECT_FALSE(written("maps.exr") == maps);
}

TEST_F(Figure, LeavesNothingOfWhatCannotBeWritten) {
  Json scene = lampScene();
  scene["polygons"][0]["radiance"] = 1e300;
  const ProgramRun run = figure(scene);
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("channel \"E\""), HasSubstr("e+299"), HasSubstr("range of 32-bit floats")));
  EXPECT_EQ(scratch_.fileCount(), 1U) << "the scene alone";
  scene["polygons"][0]["radiance"] = 1.7e308;
  const ProgramRun overflow = figure(scene);
  EXPECT_EQ(overflow.status, 1);
  EXPECT_THAT(overflow.messages,
              AllOf(HasSubstr("irradiff figure: "), HasSubstr("scene.json"), HasSubstr("range of double")));
  EXPECT_EQ(scratch_.fileCount(), 1U);
}

TEST_F(Figure, NamesWrongArguments) {
  const std::string out = path("maps");
  const auto call = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "figure");
    return runProgram(arguments);
  };
  expectRefusal(call({"7", "--analytic", "--output", out}), AllOf(HasSubstr("N: "), HasSubstr("\"7\" must be 5 or 6")));
  expectRefusal(call({"--analytic", "--output", out}), HasSubstr("N is required"));
  const auto expectMeaningless = [&](const std::vector<std::string>& arguments, const char* option) {
    expectRefusal(call(arguments),
                  AllOf(HasSubstr(option), HasSubstr("means nothing"), HasSubstr("must not be given")));
  };
  expectMeaningless({"5", "--analytic", "--rays", "16", "--output", out}, "--rays");
  expectMeaningless({"5", "--analytic", "--seed", "1", "--output", out}, "--seed");
  expectMeaningless({"6", "--analytic", "--output", out}, "--analytic");
  expectMeaningless({"6", "--rays", "16", "--output", out}, "--rays");
  for (const char* rays : {"0", "15", "16777217", "1e3", "-1"}) {
    expectRefusal(call({"5", "--rays", rays, "--output", out}),
                  AllOf(HasSubstr("--rays"), HasSubstr(rays), HasSubstr("whole number from 16 to 16777216")));
  }
  expectRefusal(call({"5", "--seed", "-1", "--output", out}), AllOf(HasSubstr("--seed"), HasSubstr("\"-1\" must be")));
  expectRefusal(call({"5", "--effort", "full", "--output", out}),
                AllOf(HasSubstr("--effort"), HasSubstr("\"full\" must be quick or standard")));
  expectRefusal(call({"5", "--analytic"}), HasSubstr("--output is required"));
  for (const char* resolution : {"0", "1025", "-4", "1e2", "12x", ""}) {
    expectRefusal(figure(lampScene(), {"--resolution", resolution}),
                  AllOf(HasSubstr("--resolution"), HasSubstr('"' + std::string(resolution) + '"'),
                        HasSubstr("whole number from 1 to 1024")));
  }
  expectRefusal(figure(lampScene(), {"--threads", "0"}), AllOf(HasSubstr("--threads"), HasSubstr("\"0\" must be")));
}

TEST_F(Figure, NamesWhatIsWrongWithTheScene) {
  expectRefusal(runProgram({"figure", "5", "--analytic", "--scene", path("none.json"), "--output", path("maps")}),
                AllOf(HasSubstr("--scene"), HasSubstr("none.json: cannot be read")));
  const auto expectScene = [&](auto spoil, const std::string& message) {
    Json scene = lampScene();
    spoil(scene);
    expectRefusal(figure(scene), AllOf(HasSubstr("--scene"), HasSubstr("scene.json: "), HasSubstr(message)));
  };
  expectScene([](Json& scene) { scene["polygons"][0]["radiance"] = -1; }, "\"lamp\"");
  expectScene(
      [](Json& scene) {
        scene["points"] = Json::parse(R"([{"position": [0,0,0], "normal": [0,0,1]}])");
        scene.erase("grid");
      },
      "has no \"grid\", must have one");
  expectScene([](Json& scene) { scene["grid"]["v"] = {0.5, 1, 0}; }, "u and v");
  expectScene([](Json& scene) { scene["grid"]["u"] = {-1, 0, 0}; }, "right-handed");
  expectScene(
      [](Json& scene) {
        scene = Json::parse(R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
          "segments": [{"name": "s", "radiance": 1, "vertices": [[0,1],[1,1]]}],
          "points": [{"position": [0,0], "normal": [0,1]}]})");
      },
      "dimension: 2, must be 3");
}

TEST_F(Figure, ReplacesNothingButAFigure) {
  fs::create_directory(path("maps"));
  writeFile(scratch_.file("maps") / "chapter.tex", "years of work");
  const ProgramRun run = figure(lampScene());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.messages, AllOf(HasSubstr("--output"), HasSubstr("is not a figure of irradiff")));
  EXPECT_EQ(written("chapter.tex"), "years of work");
}

}  // namespace
}  // namespace irradiff
