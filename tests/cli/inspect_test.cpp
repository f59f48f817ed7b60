// `irradiff inspect` as a black box: what it tells of scenes, its JSON, its exit status.

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A screen in front of a lamp: from (0.5, 0, 0) their edges are in line.
const char* const kScreened =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "a lamp behind a screen",
      "polygons": [{"name": "lamp", "vertices": [[-1,-1,2],[1,-1,2],[1,1,2],[-1,1,2]], "radiance": 1},
                   {"name": "screen", "vertices": [[-0.25,-0.25,1],[0.25,-0.25,1],[0.25,0.25,1],[-0.25,0.25,1]],
                    "radiance": 0}],
      "points": [{"position": [0,0,0], "normal": [0,0,1]}, {"position": [0.5,0,0], "normal": [0,0,1]}]})";
const char* const kFlatland =
    R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
      "segments": [{"vertices": [[-1,1],[1,1]], "radiance": 1}], "points": [{"position": [0,0], "normal": [0,1]}]})";

std::string oneLine(const std::string& scene) { return Json::parse(scene).dump() + "\n"; }

std::vector<std::string> keysOf(const OrderedJson& object) {
  std::vector<std::string> keys;
  for (const auto& field : object.items()) keys.push_back(field.key());
  return keys;
}

TEST(Inspect, TellsPeopleWhatASceneNeeds) {
  const ProgramRun run = runProgram({"inspect"}, kScreened);
  EXPECT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.messages, "");
  EXPECT_THAT(run.output, StartsWith("scene 0: 2 polygons, 2 receivers\na lamp behind a screen\n"));
  for (const char* part :
       {"occlusion                           yes", "cuts at the horizon                 no",
        "precision for 1e-12                 double", "unhidden squares a receiver",
        "partly hidden                       1\n", "black: skipped, may hide            1\n",
        "nearest visibility event            0 to 0.4 m", "Hessians                            missing at 1, good at 1",
        "the Hessian does not exist: 1 receiver\n    points[1] [0.5, 0, 0]: "}) {
    EXPECT_THAT(run.output, HasSubstr(part));
  }
}

TEST(Inspect, WritesTheFieldsOfItsJson) {
  const ProgramRun run = runProgram({"inspect", "--json", "--tolerance", "1e-20"}, kScreened);
  EXPECT_EQ(run.status, 0) << run.messages;
  ASSERT_EQ(jsonLines(run.output).size(), 1U);
  const OrderedJson line = OrderedJson::parse(run.output);
  EXPECT_THAT(keysOf(line), ElementsAre("summary", "points"));
  EXPECT_THAT(keysOf(line["summary"]),
              ElementsAre("dimension", "tolerance", "polygons", "receivers", "occlusion", "horizon",
                          "apparent_vertices", "treatments", "precision", "relative_bound", "hessian", "event_distance",
                          "jump_distance", "promised_range", "cost", "to_look_at"));
  EXPECT_EQ(line["summary"]["precision"].dump(), R"({"double":0,"extended":2,"ball":0})");
  EXPECT_EQ(line["summary"]["hessian"].dump(), R"({"missing":1,"undecided":0,"uncertain":0,"short":0,"good":1})");
  ASSERT_EQ(line["points"].size(), 2U);
  EXPECT_THAT(keysOf(line["points"][0]), ElementsAre("receiver", "position", "model", "precision", "event", "jump",
                                                     "changes_within", "hessian", "promised_range", "cost"));
  EXPECT_EQ(line["points"][0]["event"]["kind"], "vertex_on_edge");
  EXPECT_NEAR(line["points"][0]["event"]["distance"].get<double>(), 0.4, 1e-14);
  EXPECT_GE(line["points"][0]["changes_within"].get<double>(), 0.4);
  // The model is that of evaluate.
  const OrderedJson results = OrderedJson::parse(runProgram({"evaluate"}, kScreened).output)["results"];
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(line["points"][i]["model"], results[i]["model"]);
  EXPECT_EQ(line["points"][1]["hessian"], "missing");
}

TEST(Inspect, SumsUpAGrid) {
  Json scene = Json::parse(kScreened);
  scene["grid"] =
      Json::parse(R"({"origin": [-1,-1,0], "u": [2,0,0], "v": [0,2,0], "resolution": [9,9], "normal": [0,0,1]})");
  const ProgramRun run = runProgram({"inspect", "--json"}, scene.dump());
  EXPECT_EQ(run.status, 0) << run.messages;
  const Json line = Json::parse(run.output);
  EXPECT_EQ(line["summary"]["receivers"], 83);
  EXPECT_EQ(line["points"].size(), 2U) << "those of the grid are in the summary";
  EXPECT_THAT(runProgram({"inspect"}, scene.dump()).output, HasSubstr("grid ("));
}

TEST(Inspect, KnowsFlatland) {
  const ProgramRun text = runProgram({"inspect", "-"}, kFlatland);
  EXPECT_EQ(text.status, 0) << text.messages;
  EXPECT_THAT(text.output, AllOf(StartsWith("scene 0: 1 segment, 1 receiver\n"), HasSubstr("of the segments"),
                                 Not(HasSubstr("apparent vertices")), Not(HasSubstr("cost"))));
  const ProgramRun run = runProgram({"inspect", "--json"}, kFlatland);
  const Json line = Json::parse(run.output);
  EXPECT_EQ(line["summary"]["dimension"], 2);
  EXPECT_EQ(line["summary"]["segments"], 1);
  EXPECT_TRUE(line["summary"]["cost"].is_null());
  EXPECT_EQ(line["points"][0]["event"]["kind"], "edge_on");
  EXPECT_EQ(line["points"][0]["event"]["distance"], 1.0);
}

TEST(Inspect, PutsAnErrorInTheSceneSPlace) {
  Json wrong = Json::parse(kScreened);
  wrong["polygons"][0]["vertices"][0] = {0, 0, 5};
  for (const bool is_json : {false, true}) {
    std::vector<std::string> call = {"inspect"};
    if (is_json) call.emplace_back("--json");
    const ProgramRun run = runProgram(call, oneLine(kScreened) + wrong.dump() + "\n{\n" + oneLine(kFlatland));
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.messages,
                AllOf(StartsWith("irradiff inspect: 2 of 4 scenes could not be inspected; first scene 1: "),
                      HasSubstr("lamp"), HasSubstr("plane")));
    if (is_json) {
      const std::vector<Json> lines = jsonLines(run.output);
      ASSERT_EQ(lines.size(), 4U);
      EXPECT_TRUE(lines[0].contains("summary"));
      EXPECT_THAT(lines[1].at("error").get<std::string>(), HasSubstr("polygons[0] \"lamp\""));
      EXPECT_TRUE(lines[2].contains("error"));
      EXPECT_TRUE(lines[3].contains("summary"));
    } else {
      EXPECT_THAT(run.output, AllOf(HasSubstr("scene 0: 2 polygons"), HasSubstr("\n\nscene 1: polygons[0] \"lamp\""),
                                    HasSubstr("\n\nscene 3: 1 segment")));
    }
  }
}

TEST(Inspect, RefusesAReceiverAsEvaluateDoes) {
  Json scene = Json::parse(kScreened);
  scene["points"][1]["position"] = {0.25, 0, 1};
  const ProgramRun run = runProgram({"inspect", "--json"}, scene.dump());
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(Json::parse(run.output).at("error"),
            Json::parse(runProgram({"evaluate"}, scene.dump()).output).at("error"));
}

TEST(Inspect, SaysWhatIsWrongWithACall) {
  struct WrongCall {
    std::vector<std::string> arguments;
    std::string part;
  };
  for (const WrongCall& call :
       std::vector<WrongCall>{{{"inspect", "nowhere.json"}, "nowhere.json: No such file"},
                              {{"inspect", "/tmp"}, "/tmp is a folder"},
                              {{"inspect", "--tolerance", "0"}, "--tolerance: \"0\" must be a number from 1e-60 to 1"},
                              {{"inspect", "--tolerance", "1e-61"}, "--tolerance"},
                              {{"inspect", "--tolerance", "2"}, "--tolerance: \"2\" must be"},
                              {{"inspect", "--tolerance", "tiny"}, "tiny"},
                              {{"inspect", "--tolerance", "nan"}, "\"nan\" must be a number"},
                              {{"inspect", "--output", ""}, "--output"},
                              {{"inspect", "--method", "exact"}, "--method"}}) {
    const ProgramRun run = runProgram(call.arguments, kScreened);
    EXPECT_EQ(run.status, 2) << call.arguments.back();
    EXPECT_THAT(run.messages, HasSubstr(call.part));
    EXPECT_EQ(run.output, "");
  }
  const ProgramRun empty = runProgram({"inspect"}, "\n");
  EXPECT_EQ(empty.status, 1);
  EXPECT_THAT(empty.messages, HasSubstr("standard input is empty, must hold at least one scene"));
}

TEST(Inspect, WritesAFileWhole) {
  const ScratchFolder scratch;
  writeFile(scratch.file("scene.json"), kScreened);
  const ProgramRun run = runProgram({"inspect", scratch.file("scene.json"), "--output", scratch.file("findings.txt")});
  EXPECT_EQ(run.status, 0) << run.messages;
  EXPECT_EQ(run.output, "");
  EXPECT_EQ(readFile(scratch.file("findings.txt")), runProgram({"inspect"}, kScreened).output);
  EXPECT_EQ(runProgram({"inspect", "--output", scratch.file("findings.txt")}, " ").status, 1);
  EXPECT_THAT(readFile(scratch.file("findings.txt")), StartsWith("scene 0")) << "a failure leaves it as it was";
  EXPECT_EQ(scratch.fileCount(), 2);
  const ProgramRun full = runProgramBetween({"inspect"}, scratch.file("scene.json"), "/dev/full");
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.messages, HasSubstr("cannot write standard output: No space left on device"));
}

}  // namespace
}  // namespace irradiff
