// Every kind of bad input through the program: an error line that names the thing, its value and the rule; never a
// crash, nor a number.

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace irradiff {
namespace {

struct BadScene {
  std::string kind;
  std::string polygon;             ///< the fields of polygons[0] "emitter" but for its name
  std::string point;               ///< the fields of points[0]
  std::vector<std::string> parts;  ///< of the message
};

const char* const kGoodPolygon = R"("vertices": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "radiance": 1)";
const char* const kGoodPoint = R"("position": [0.25,0.5,0], "normal": [0,0,1])";

std::string sceneOf(const std::string& polygon, const std::string& point) {
  return R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "polygons": [{"name": "emitter", )" + polygon +
         R"(}], "points": [{)" + point + "}]}\n";
}

TEST(BadInput, GetsAnErrorThatNamesThePolygonTheValueAndTheRule) {
  const std::string name = "polygons[0] \"emitter\"";
  const std::vector<BadScene> scenes{
      {"not planar", R"("vertices": [[0,0,1],[1,0,1],[1,1,1.5],[0,1,1]], "radiance": 1)", kGoodPoint, {name, "plan"}},
      {"self-intersecting",
       R"("vertices": [[0,0,1],[1,1,1],[1,0,1],[0,1,1]], "radiance": 1)",
       kGoodPoint,
       {name, "edge"}},
      {"repeated vertices",
       R"("vertices": [[0,0,1],[1,0,1],[1,0,1],[0,1,1]], "radiance": 1)",
       kGoodPoint,
       {name, "vertex 2", "(1, 0, 1)"}},
      {"two vertices", R"("vertices": [[0,0,1],[1,0,1]], "radiance": 1)", kGoodPoint, {name, "2", "3"}},
      {"no area", R"("vertices": [[0,0,1],[1,0,1],[2,0,1]], "radiance": 1)", kGoodPoint, {name}},
      {"NaN",
       R"("vertices": [[0,0,1],[1,NaN,1],[1,1,1]], "radiance": 1)",
       kGoodPoint,
       {name, "vertices[1][1]: is NaN, must be a finite number"}},
      {"infinity",
       R"("vertices": [[0,0,1],[1,0,1],[1,1,-Infinity]], "radiance": 1)",
       kGoodPoint,
       {name, "vertices[2][2]: is -Infinity, must be a finite number"}},
      {"overflow",
       R"("vertices": [[0,0,1e999],[1,0,1],[1,1,1]], "radiance": 1)",
       kGoodPoint,
       {name, "vertices[0][2]: is 1e999, must be a finite number that fits in a double"}},
      {"infinite radiance",
       R"("vertices": [[0,0,1],[1,0,1],[1,1,1]], "radiance": 1e400)",
       kGoodPoint,
       {name, "radiance: is 1e400, must be a finite number"}},
      {"NaN in a normal",
       kGoodPolygon,
       R"("position": [0,0,0], "normal": [0,nan,1])",
       {"points[0]", "normal[1]: is nan"}},
      {"negative radiance",
       R"("vertices": [[0,0,1],[1,0,1],[1,1,1]], "radiance": -0.5)",
       kGoodPoint,
       {name, "-0.5", "radiance"}},
      {"wrong dimension",
       R"("vertices": [[0,0],[1,0],[1,1]], "radiance": 1)",
       kGoodPoint,
       {name, "vertices[0]", "3 numbers", "2"}},
      {"no radiance", R"("vertices": [[0,0,1],[1,0,1],[1,1,1]])", kGoodPoint, {name, "radiance", "missing"}},
      {"misspelt field",
       R"("vertices": [[0,0,1],[1,0,1],[1,1,1]], "radiance": 1, "radiace": 2)",
       kGoodPoint,
       {"polygons[0]", "radiace"}},
      {"text for a number",
       R"("vertices": [[0,0,"1"],[1,0,1],[1,1,1]], "radiance": 1)",
       kGoodPoint,
       {name, "vertices[0][2]"}},
      {"normal not a unit vector", kGoodPolygon, R"("position": [0,0,0], "normal": [0,0,2])", {"normal", "2", "1"}},
      {"receiver on a vertex",
       kGoodPolygon,
       R"("position": [1,0,1], "normal": [0,0,1])",
       {name, "[1, 0, 1]", "vertices[1]"}},
      {"receiver on an edge",
       kGoodPolygon,
       R"("position": [0.5,0,1], "normal": [0,0.6,0.8])",
       {name, "[0.5, 0, 1]", "edge"}},
      {"receiver inside",
       kGoodPolygon,
       R"("position": [0.5,0.5,1], "normal": [0,0.6,0.8])",
       {name, "[0.5, 0.5, 1]", "inside"}},
      {"out of range",
       R"("vertices": [[0,0,1e-200],[1e-200,0,1e-200],[0,1e-200,1e-200]], "radiance": 1)",
       R"("position": [0,0,0], "normal": [0,0,1])",
       {name, "range of double"}},
  };
  // All in one file, a good scene between each two: an error must not reach its neighbours.
  std::string input;
  for (const BadScene& scene : scenes) input += sceneOf(scene.polygon, scene.point) + sceneOf(kGoodPolygon, kGoodPoint);
  const ProgramRun run = runProgram({"evaluate"}, input);
  EXPECT_EQ(run.status, 1);
  const std::vector<nlohmann::json> lines = jsonLines(run.output);
  ASSERT_EQ(lines.size(), 2 * scenes.size());
  const nlohmann::json good = nlohmann::json::parse(runProgram({"evaluate"}, sceneOf(kGoodPolygon, kGoodPoint)).output);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SCOPED_TRACE(scenes[i].kind);
    ASSERT_TRUE(lines[2 * i].contains("error")) << lines[2 * i];
    const std::string message = lines[2 * i]["error"];
    for (const std::string& part : scenes[i].parts) EXPECT_THAT(message, testing::HasSubstr(part));
    if (scenes[i].parts.front() == name) {
      EXPECT_THAT(message, testing::ContainsRegex("^polygon( 0|s\\[0\\]) \"emitter\": "));
    }
    EXPECT_EQ(lines[2 * i + 1], good);
  }
}

TEST(BadInput, NamesTheSourceThatTakesTheSumBeyondDouble) {
  const auto scene = [](const std::string& radiance) {
    return R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "polygons": [
      {"name": "lamp", "radiance": 1, "vertices": [[3,0,1],[4,0,1],[3,1,1]]},
      {"name": "sun", "radiance": )" +
           radiance + R"(, "vertices": [[1,1,1],[-1,1,1],[-1,-1,1],[1,-1,1]]}], "points": [
      {"position": [0,0,0], "normal": [0,0,1]}]})";
  };
  const auto flat = [](const std::string& radiance) {
    return R"({"format": "irradiff-scene", "version": 1, "dimension": 2, "segments": [
      {"name": "lamp", "radiance": 1, "vertices": [[-3,0.01],[-2,0.01]]},
      {"name": "sun", "radiance": )" +
           radiance + R"(, "vertices": [[-0.5,1e-2],[0.5,1e-2]]}], "points": [{"position": [0,0], "normal": [0,1]}]})";
  };
  const ProgramRun run = runProgram({"evaluate"}, scene("1.7e308"));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(nlohmann::json::parse(run.output).at("error").get<std::string>(),
              testing::AllOf(testing::StartsWith("polygons[1] \"sun\": its radiance 1.7e+308"),
                             testing::HasSubstr("beyond the range of double")));
  const ProgramRun flat_run = runProgram({"evaluate"}, flat("1.7e308"));
  EXPECT_EQ(flat_run.status, 1);
  EXPECT_THAT(nlohmann::json::parse(flat_run.output).at("error").get<std::string>(),
              testing::StartsWith("segments[1] \"sun\": its radiance 1.7e+308"));
  EXPECT_EQ(runProgram({"evaluate"}, scene("1.7e200")).status, 0);
  EXPECT_EQ(runProgram({"evaluate"}, flat("1.7e200")).status, 0);
}

TEST(BadInput, MayBeAnyText) {
  const std::string scene = sceneOf(kGoodPolygon, kGoodPoint);
  const std::vector<std::string> texts{"null",
                                       "[]",
                                       "{}",
                                       "17",
                                       "\"scene\"",
                                       scene.substr(0, scene.size() / 2),
                                       std::string(100000, '['),
                                       std::string("\x00\x01\xff\xfe{", 5),
                                       R"({"format": "irradiff-scene", "version": 2, "dimension": 3})",
                                       R"({"format": "irradiff-scene", "version": 1, "dimension": 4})",
                                       R"({"format": "irradiff-samples", "version": 1})"};
  for (const std::string& text : texts) {
    const ProgramRun run = runProgram({"evaluate"}, text);
    EXPECT_EQ(run.status, 1) << text.substr(0, 40);
    const std::vector<nlohmann::json> lines = jsonLines(run.output);
    ASSERT_EQ(lines.size(), 1) << text.substr(0, 40);
    EXPECT_FALSE(lines[0].at("error").get<std::string>().empty());
  }
}

TEST(BadInput, InFlatlandNamesTheSegment) {
  const std::string head =
      R"({"format": "irradiff-scene", "version": 1, "dimension": 2, "segments": [{"name": "wall", )";
  const std::string point = R"(}], "points": [{"position": [0,0], "normal": [0,1]}]})";
  const std::vector<std::pair<std::string, std::string>> segments{
      {R"("vertices": [[1,1],[1,1]], "radiance": 1)", "(1, 1)"},
      {R"("vertices": [[0,0],[1,1]], "radiance": 1)", "is on one of its ends"},
      {R"("vertices": [[0,1],[1,1]], "radiance": -2)", "-2"}};
  for (const auto& [segment, part] : segments) {
    std::string scene = head;
    scene += segment;
    scene += point;
    const ProgramRun run = runProgram({"evaluate"}, scene);
    EXPECT_EQ(run.status, 1);
    const std::string message = nlohmann::json::parse(run.output).at("error");
    EXPECT_THAT(message,
                testing::AllOf(testing::ContainsRegex("^segment( 0|s\\[0\\]) \"wall\": "), testing::HasSubstr(part)));
  }
  const ProgramRun appendix =
      runProgram({"evaluate", "--method", "appendix"}, head + R"("vertices": [[0,1],[1,1]], "radiance": 1)" + point);
  EXPECT_EQ(appendix.status, 1);
  EXPECT_THAT(appendix.output, testing::HasSubstr("dimension: 2, must be 3 for the appendix form"));
}

}  // namespace
}  // namespace irradiff
