// `irradiff evaluate` as a black box: its output's shape, its numbers against closed forms, its exit status.

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const char* const kSquare =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "a square over its corner",
      "polygons": [{"name": "square", "vertices": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "radiance": 2}],
      "points": [{"position": [0,0,0], "normal": [0,0,1]}, {"position": [0,0,2], "normal": [0,0,-1]}]})";
const char* const kSegment =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
      "segments": [{"vertices": [[-1,1],[1,1]], "radiance": 1}], "points": [{"position": [0,0], "normal": [0,1]}]})";

/// On one line, as JSON Lines have it.
std::string oneLine(const std::string& scene) { return Json::parse(scene).dump() + "\n"; }

std::vector<std::string> keysOf(const OrderedJson& object) {
  std::vector<std::string> keys;
  for (const auto& field : object.items()) keys.push_back(field.key());
  return keys;
}

OrderedJson onlyResult(const std::string& output) { return OrderedJson::parse(output).at("results").at(0); }

TEST(Evaluate, WritesTheFieldsOfTheFormatInTheirOrderAndShapes) {
  const ProgramRun run = runProgram({"evaluate"}, kSquare);
  EXPECT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.messages, "");
  EXPECT_EQ(std::ranges::count(run.output, '\n'), 1);
  EXPECT_THAT(keysOf(OrderedJson::parse(run.output)), ElementsAre("results"));
  EXPECT_EQ(OrderedJson::parse(run.output).at("results").size(), 2);
  const OrderedJson result = onlyResult(run.output);
  EXPECT_THAT(keysOf(result), ElementsAre("irradiance", "gradient", "hessian", "tangential_hessian",
                                          "rotational_gradient", "error_bound", "model"));
  EXPECT_EQ(result["gradient"].size(), 3);
  EXPECT_EQ(result["hessian"].size(), 3);
  for (const OrderedJson& row : result["hessian"]) EXPECT_EQ(row.size(), 3);
  EXPECT_EQ(result["tangential_hessian"].size(), 2);
  for (const OrderedJson& row : result["tangential_hessian"]) EXPECT_EQ(row.size(), 2);
  EXPECT_EQ(result["rotational_gradient"].size(), 3);
  EXPECT_THAT(keysOf(result["error_bound"]),
              ElementsAre("irradiance", "gradient", "hessian", "tangential_hessian", "rotational_gradient"));
  EXPECT_EQ(result["model"].dump(),
            R"({"occlusion":false,"horizon":false,"apparent_vertices":0,"precision":"double",)"
            R"("polygons":{"area_rule":0,"boundary":1,"partly_hidden":0,"black":0,"hidden":0,"edge_on":0,)"
            R"("own_surface":0,"below_horizon":0}})");
}

TEST(Evaluate, WritesFlatlandInItsShapes) {
  const ProgramRun run = runProgram({"evaluate", "-"}, kSegment);
  EXPECT_EQ(run.status, 0) << run.messages;
  const OrderedJson result = onlyResult(run.output);
  EXPECT_EQ(result["gradient"].size(), 2);
  EXPECT_EQ(result["hessian"].size(), 2);
  for (const OrderedJson& row : result["hessian"]) EXPECT_EQ(row.size(), 2);
  ASSERT_EQ(result["tangential_hessian"].size(), 1);
  EXPECT_EQ(result["tangential_hessian"][0].size(), 1);
  EXPECT_EQ(result["rotational_gradient"].size(), 1);
  // E = sin of half the angle, twice: the segment from -45 to 45 degrees.
  EXPECT_NEAR(result["irradiance"].get<double>(), std::numbers::sqrt2, 4 * 0x1p-52);
  // E(x) = f(1 - x) + f(1 + x) with f(s) = s / sqrt(1 + s^2), whose second derivative is -3 s / (1 + s^2)^(5/2).
  EXPECT_NEAR(result["tangential_hessian"][0][0].get<double>(), -3.0 / (2.0 * std::numbers::sqrt2), 16 * 0x1p-52);
  // Counterclockwise turns change E by the first moment of sine, which vanishes by symmetry.
  EXPECT_NEAR(result["rotational_gradient"][0].get<double>(), 0.0, 4 * 0x1p-52);
}

/// E of radiance 1 under the corner of an a x b rectangle at distance 1 (configuration B-3 of Howell's catalogue).
double irradianceUnderCorner(double a, double b) {
  const double x = std::sqrt(1 + a * a);
  const double y = std::sqrt(1 + b * b);
  return 0.5 * (a / x * std::atan(b / x) + b / y * std::atan(a / y));
}

TEST(Evaluate, AgreesWithTheClosedFormForEachMethodAndEachSide) {
  for (const std::string method : {"boundary", "appendix"}) {
    const ProgramRun run = runProgram({"evaluate", "--method", method, "--precision", "double"}, kSquare);
    EXPECT_EQ(run.status, 0) << run.messages;
    const Json results = Json::parse(run.output).at("results");
    for (const Json& result : results) {
      EXPECT_NEAR(result["irradiance"].get<double>(), 2 * irradianceUnderCorner(1, 1), 16 * 0x1p-52) << method;
      // Moved along the square's sides by one step, E changes as the closed form by the rectangles left and right.
      const double step = 1e-4;
      const double forward = irradianceUnderCorner(1 - step, 1) + irradianceUnderCorner(step, 1);
      const double backward = irradianceUnderCorner(1 + step, 1) - irradianceUnderCorner(step, 1);
      // Differences are off by step^2/6 and step^2/12 of derivatives of order 1, and by rounding: the second one by
      // 8 u E / step^2 = 1e-7.
      EXPECT_NEAR(result["gradient"][0].get<double>(), 2 * (forward - backward) / (2 * step), 1e-7) << method;
      EXPECT_NEAR(result["hessian"][0][0].get<double>(),
                  2 * (forward - 2 * irradianceUnderCorner(1, 1) + backward) / (step * step), 1e-6)
          << method;
      EXPECT_LE(result["error_bound"]["irradiance"].get<double>(), 1e-13);
      EXPECT_LE(result["error_bound"]["hessian"].get<double>(), 1e-11);
    }
  }
}

TEST(Evaluate, CutsAtTheHorizonByEachMethod) {
  Json scene = Json::parse(kSquare);
  scene["points"] =
      Json::parse(R"([{"position": [0.5,-1,0], "normal": [0,-0.6,0.8]}, {"position": [0.5,2,0.5], "normal": [0,0,1]},
                                   {"position": [0.5,-0.5,0.5], "normal": [0,0.8,0.6]}, {"position": [0.3,0.4,0.5], "normal": [1,0,0]}])");
  const Json boundary = Json::parse(runProgram({"evaluate"}, scene.dump()).output);
  const Json appendix = Json::parse(runProgram({"evaluate", "--method", "appendix"}, scene.dump()).output);
  // The last receiver looks along the ceiling: half of the square is behind it.
  EXPECT_EQ(boundary["results"][3]["model"]["horizon"], true);
  EXPECT_EQ(boundary["results"][2]["model"]["horizon"], false);
  for (std::size_t i = 0; i < 4; ++i) {
    const Json& b = boundary["results"][i];
    const Json& a = appendix["results"][i];
    EXPECT_EQ(a["model"], b["model"]);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        const double difference = a["hessian"][row][column].get<double>() - b["hessian"][row][column].get<double>();
        EXPECT_LE(std::abs(difference), a["error_bound"]["hessian"].get<double>()) << i;
      }
      EXPECT_NEAR(a["rotational_gradient"][row].get<double>(), b["rotational_gradient"][row].get<double>(), 1e-14);
    }
    // Both forms are well conditioned here; a missing term of the cut would be of order 1.
    EXPECT_LE(a["error_bound"]["hessian"].get<double>(), 1e-11) << i;
  }
}

TEST(Evaluate, MeasuresTheErrorOfTheAppendixFormInItsBound) {
  Json scene = Json::parse(kSquare);
  scene["polygons"][0]["vertices"] = Json::parse("[[0,0,1000],[1e-6,0,1000],[1e-6,1e-6,1000],[0,1e-6,1000]]");
  scene["points"] = Json::parse(R"([{"position": [0.25,0.5,0], "normal": [0,0,1]}])");
  const OrderedJson boundary = onlyResult(runProgram({"evaluate"}, scene.dump()).output);
  const OrderedJson appendix = onlyResult(runProgram({"evaluate", "--method", "appendix"}, scene.dump()).output);
  const double hessian = std::abs(boundary["hessian"][2][2].get<double>());
  EXPECT_LE(boundary["error_bound"]["hessian"].get<double>(), 1e-12 * hessian);
  // The distance is 1e9 times the size: already u (distance/size)^2 is above 1, and nothing is left.
  EXPECT_GE(appendix["error_bound"]["hessian"].get<double>(), hessian);
}

TEST(Evaluate, SaysWhereTheAppendixFormHasNoFiniteValue) {
  Json scene = Json::parse(kSquare);
  // It divides by |r x r'|^2, which underflows here.
  const auto shrink = [](Json& point) {
    for (Json& coordinate : point) coordinate = coordinate.get<double>() * 1e-120;
  };
  for (Json& vertex : scene["polygons"][0]["vertices"]) shrink(vertex);
  for (Json& receiver : scene["points"]) shrink(receiver["position"]);
  const ProgramRun run = runProgram({"evaluate", "--method", "appendix"}, scene.dump());
  EXPECT_EQ(run.status, 0) << run.messages;
  const OrderedJson result = onlyResult(run.output);
  for (const char* field : {"irradiance", "gradient", "hessian", "tangential_hessian", "rotational_gradient"}) {
    EXPECT_TRUE(result[field].is_null()) << field;
  }
  for (const OrderedJson& bound : result["error_bound"]) EXPECT_TRUE(bound.is_null());
  EXPECT_THAT(result["reason"].get<std::string>(), AllOf(HasSubstr("polygons[0] \"square\""), HasSubstr("appendix")));
}

TEST(Evaluate, GivesAWrongSceneItsLineAndGoesOn) {
  const ProgramRun run =
      runProgram({"evaluate"}, oneLine(kSquare) + "{\"format\": \n" + "not JSON\n" + oneLine(kSegment));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.messages, HasSubstr("2 of 4 scenes could not be evaluated; first scene 1: not JSON"));
  const std::vector<Json> lines = jsonLines(run.output);
  ASSERT_EQ(lines.size(), 4);
  EXPECT_TRUE(lines[0].contains("results"));
  EXPECT_THAT(lines[1].at("error").get<std::string>(), HasSubstr("line 1, column"));
  EXPECT_EQ(lines[1].size(), 1);
  EXPECT_TRUE(lines[2].contains("error"));
  EXPECT_TRUE(lines[3].contains("results"));
  // What is evaluated does not depend on its neighbours.
  EXPECT_EQ(run.output.substr(0, run.output.find('\n') + 1), runProgram({"evaluate"}, kSquare).output);
}

TEST(Evaluate, ReadsAFileAndWritesOneWhole) {
  const ScratchFolder scratch;
  writeFile(scratch.file("scene.json"), kSquare);
  const std::string expected = runProgram({"evaluate"}, kSquare).output;
  const ProgramRun run =
      runProgram({"evaluate", scratch.file("scene.json"), "--output", scratch.file("results.jsonl")});
  EXPECT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.output, "");
  EXPECT_EQ(readFile(scratch.file("results.jsonl")), expected);
  EXPECT_EQ(scratch.fileCount(), 2);
}

TEST(Evaluate, LeavesNoFileBehindAFailure) {
  const ScratchFolder scratch;
  const ProgramRun empty = runProgram({"evaluate", "--output", scratch.file("results.jsonl")}, " \n\n");
  EXPECT_EQ(empty.status, 1);
  EXPECT_THAT(empty.messages, HasSubstr("standard input is empty, must hold at least one scene"));
  EXPECT_EQ(scratch.fileCount(), 0);
  writeFile(scratch.file("results.jsonl"), "kept");
  EXPECT_EQ(runProgram({"evaluate", "--output", scratch.file("results.jsonl")}).status, 1);
  EXPECT_EQ(readFile(scratch.file("results.jsonl")), "kept");
  EXPECT_EQ(scratch.fileCount(), 1);
  // A wrong scene is no failure of the file: its line is there.
  EXPECT_EQ(runProgram({"evaluate", "--output", scratch.file("results.jsonl")}, "{}").status, 1);
  EXPECT_THAT(readFile(scratch.file("results.jsonl")), StartsWith("{\"error\":"));
}

TEST(Evaluate, SaysThatStandardOutputIsFull) {
  const ScratchFolder scratch;
  writeFile(scratch.file("scene.json"), kSquare);
  const ProgramRun run = runProgramBetween({"evaluate"}, scratch.file("scene.json"), "/dev/full");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.messages, HasSubstr("cannot write standard output: No space left on device"));
}

TEST(Evaluate, SeesWhatOneBlockerLeavesOfALamp) {
  Json scene = Json::parse(kSquare);
  const double whole =
      Json::parse(runProgram({"evaluate"}, scene.dump()).output).at("results").at(0).at("irradiance").get<double>();
  Json blocker = scene["polygons"][0];
  blocker["name"] = "blocker";
  blocker["radiance"] = 0;
  for (Json& vertex : blocker["vertices"])
    vertex = {0.25 * vertex[0].get<double>(), 0.25 * vertex[1].get<double>(), 0.5};
  scene["polygons"].push_back(blocker);
  const ProgramRun run = runProgram({"evaluate"}, scene.dump());
  EXPECT_EQ(run.status, 0) << run.messages;
  const Json result = Json::parse(run.output).at("results").at(0);
  EXPECT_TRUE(result.at("model").at("occlusion").get<bool>());
  EXPECT_LT(result.at("irradiance").get<double>(), whole);
  EXPECT_GT(result.at("irradiance").get<double>(), 0.0);
  // The appendix form has no occlusion.
  const ProgramRun appendix = runProgram({"evaluate", "--method", "appendix"}, scene.dump());
  EXPECT_EQ(appendix.status, 1);
  EXPECT_THAT(appendix.output, AllOf(HasSubstr("square"), HasSubstr("hidden"), HasSubstr("boundary form")));
}

TEST(Evaluate, RefusesOverlapInOnePlaneNamingBothPolygons) {
  Json scene = Json::parse(kSquare);
  Json other = scene["polygons"][0];
  other["name"] = "poster";
  other["radiance"] = 0;
  scene["polygons"].push_back(other);
  const ProgramRun run = runProgram({"evaluate"}, scene.dump());
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(Json::parse(run.output).at("error").get<std::string>(),
              AllOf(HasSubstr("polygons[0] \"square\""), HasSubstr("polygons[1] \"poster\""), HasSubstr("overlap")));
}

TEST(Evaluate, IsDeterministic) {
  const std::string input = oneLine(kSquare) + oneLine(kSegment);
  EXPECT_EQ(runProgram({"evaluate"}, input).output, runProgram({"evaluate"}, input).output);
}

struct WrongCall {
  std::vector<std::string> arguments;
  std::string message;
};

TEST(WrongCall, HasStatusTwoAndSaysWhatIsWrong) {
  const std::vector<WrongCall> calls{
      {{}, "a command is missing"},
      {{"evalute"}, "evalute"},
      {{"evaluate", "--metod", "boundary"}, "--metod"},
      {{"evaluate", "--method", "magic"}, "magic"},
      {{"evaluate", "--precision", "single"}, "single"},
      {{"evaluate", "--tolerance", "1e-6"}, "--tolerance: must come with --precision certified"},
      {{"evaluate", "--precision", "certified", "--tolerance", "0"}, "tolerance: 0, must be from 1e-60 to 1"},
      {{"evaluate", "--precision", "certified", "--tolerance", "nan"}, "tolerance: nan, must be from 1e-60 to 1"},
      {{"evaluate", "--precision", "certified", "--tolerance", "1e-61"}, "--tolerance"},
      {{"evaluate", "--precision", "certified", "--tolerance", "2"}, "--tolerance"},
      {{"evaluate", "--precision", "certified", "--tolerance", "tiny"}, "--tolerance"},
      {{"evaluate", "--precision", "certified", "--method", "appendix"}, "must be double for --method appendix"},
      {{"evaluate", "/no/such/file"}, "/no/such/file: No such file"},
      {{"evaluate", "/"}, "/ is a folder"},
      {{"evaluate", "--output", "/no/such/folder/results.jsonl"}, "/no/such/folder/results.jsonl"},
      {{"evaluate", "--output", ""}, "--output"},
      {{"evaluate", "a.json", "b.json"}, "b.json"},
  };
  for (const WrongCall& call : calls) {
    const ProgramRun run = runProgram(call.arguments, kSquare);
    EXPECT_EQ(run.status, 2) << call.message;
    EXPECT_EQ(run.output, "") << call.message;
    EXPECT_THAT(run.messages, HasSubstr(call.message));
  }
}

TEST(Program, TellsItsVersionAndItsHelp) {
  const ProgramRun version = runProgram({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.output, testing::MatchesRegex("irradiff [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  const ProgramRun help = runProgram({"evaluate", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.output, AllOf(HasSubstr("--output"), HasSubstr("--method"), HasSubstr("Exit status")));
}

}  // namespace
}  // namespace irradiff
