// `irradiff import` as a black box: what it writes, what it says, and that `irradiff evaluate` gets the known
// irradiance from it.

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A box around the origin whose faces are quads; all of `material`.
std::string boxOf(const std::string& material) {
  return "mtllib box.mtl\no box\nv -1 -1.5 -0.75\nv 1 -1.5 -0.75\nv 1 1.25 -0.75\nv -1 1.25 -0.75\n"
         "v -1 -1.5 2\nv 1 -1.5 2\nv 1 1.25 2\nv -1 1.25 2\nusemtl " +
         material + "\nf 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

const std::string kMaterials = "newmtl white\nKe 1 1 1\nnewmtl tinted\nKe 2 1 0.5\nnewmtl black\nKd 1 1 1\n";
const std::vector<std::string> kInside{"--receiver", "0.25,-0.5,0.125,0.48,0.6,0.64", "--receiver=-0.5,0,0,0,0,-1"};

class Import : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return scratch_.file(name).string(); }

  ProgramRun import(const std::string& model, const std::vector<std::string>& options = {}) const {
    writeFile(file("box.mtl"), kMaterials);
    writeFile(file("model.obj"), model);
    std::vector<std::string> arguments{"import", file("model.obj"), "--output", file("scene.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runProgram(arguments);
  }

  Json scene() const { return Json::parse(readFile(file("scene.json"))); }

  std::vector<Json> results() const {
    const ProgramRun run = runProgram({"evaluate", file("scene.json")});
    EXPECT_EQ(run.status, 0) << run.messages;
    return Json::parse(run.output).at("results");
  }

  ScratchFolder scratch_;
};

double maxNorm(const Json& value) {
  if (value.is_number()) return std::abs(value.get<double>());
  double largest = 0;
  for (const Json& entry : value) largest = std::max(largest, maxNorm(entry));
  return largest;
}

/// Whether a closed room of this radiance is seen: E is pi L and its derivatives vanish, within the bounds.
bool isClosedRoom(const Json& result, double radiance) {
  const Json& bound = result.at("error_bound");
  const double expected = std::numbers::pi * radiance;
  return std::abs(result.at("irradiance").get<double>() - expected) <=
             bound.at("irradiance").get<double>() + 0x1p-52 * expected &&
         maxNorm(result.at("gradient")) <= bound.at("gradient").get<double>() &&
         maxNorm(result.at("hessian")) <= bound.at("hessian").get<double>() &&
         bound.at("hessian").get<double>() < 1e-10;
}

TEST_F(Import, MakesASceneOfWhichEvaluateGetsTheIrradianceInAClosedBox) {
  const ProgramRun run = import(boxOf("white"), kInside);
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.messages, "");
  EXPECT_EQ(run.output, "");
  EXPECT_EQ(scene().at("description"), "Imported from model.obj");
  EXPECT_EQ(scene().at("polygons").size(), 6U);
  EXPECT_EQ(scene().at("polygons")[5].at("name"), "box face 6");
  const std::vector<Json> inside = results();
  ASSERT_EQ(inside.size(), 2U);
  for (const Json& result : inside) {
    EXPECT_TRUE(isClosedRoom(result, 1)) << result;
    EXPECT_FALSE(isClosedRoom(result, 1.001));
  }
}

TEST_F(Import, LosesTheClosedBoxWithOneFace) {
  std::string open = boxOf("white");
  open.replace(open.find("f 5 6 7 8\n"), 10, "");
  ASSERT_EQ(import(open, kInside).status, 0);
  const std::vector<Json> inside = results();
  EXPECT_FALSE(isClosedRoom(inside[0], 1)) << inside[0];
  // The second receiver looks away from it.
  EXPECT_TRUE(isClosedRoom(inside[1], 1)) << inside[1];
}

TEST_F(Import, TakesTheLuminanceOfKe) {
  ASSERT_EQ(import(boxOf("tinted"), kInside).status, 0);
  for (const Json& result : results()) EXPECT_TRUE(isClosedRoom(result, 0.2126 * 2 + 0.7152 + 0.0722 * 0.5)) << result;
}

TEST_F(Import, SplitsFacesThatAreNotPlanarAndCountsThem) {
  // With one corner moved, three faces are bent; the box stays closed.
  std::string bent = boxOf("white");
  bent.replace(bent.find("v 1 1.25 2\n"), 11, "v 1.1 1.3 2.2\n");
  const ProgramRun run = import(bent, kInside);
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.messages,
            "irradiff import: " + file("model.obj") + ": 3 of 6 faces not planar, split into 6 triangles\n");
  EXPECT_EQ(scene().at("polygons").size(), 9U);
  EXPECT_EQ(scene().at("polygons")[1].at("name"), "box face 2.1");
  for (const Json& result : results()) EXPECT_TRUE(isClosedRoom(result, 1)) << result;
}

TEST_F(Import, KeepsSeventeenDigits) {
  const ProgramRun run = import(
      "v 0.12345678901234567 1e-7 0.1\nv 1.0000000000000002 -0 3\nv 0.30000000000000004 7.0000000000000009 3\nf 1 2 "
      "3\n");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(scene().at("polygons")[0].at("vertices"),
            Json::parse("[[0.12345678901234567, 1e-7, 0.1], [1.0000000000000002, -0.0, 3.0], "
                        "[0.30000000000000004, 7.0000000000000009, 3.0]]"));
}

TEST_F(Import, SaysWhatWasLeftOutAndWhatIsMissing) {
  const ProgramRun run = import("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 1 2\nl 1 2\np 3\n");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.messages,
              AllOf(HasSubstr(": 1 face without an area left out\n"),
                    HasSubstr(": 2 vertices equal to the one before left out\n"),
                    HasSubstr(": 2 points, lines, curves or surfaces left out: only faces are read\n"),
                    HasSubstr(": nothing radiates: no face has a material with Ke above 0\n"),
                    HasSubstr(": the scene has no receivers: give --receiver, or add \"points\" or a \"grid\""),
                    Not(HasSubstr("not planar"))));
  const ProgramRun evaluation = runProgram({"evaluate", file("scene.json")});
  EXPECT_EQ(evaluation.status, 1);
  EXPECT_THAT(evaluation.output, HasSubstr("has no receivers"));
  EXPECT_THAT(import(boxOf("black"), kInside).messages, HasSubstr("nothing radiates"));
}

TEST_F(Import, WritesToStandardOutputUnlessToldOtherwise) {
  ASSERT_EQ(import(boxOf("white"), kInside).status, 0);
  std::vector<std::string> arguments{"import", file("model.obj")};
  arguments.insert(arguments.end(), kInside.begin(), kInside.end());
  const ProgramRun run = runProgram(arguments);
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.output, readFile(file("scene.json")));
  writeFile(file("empty"), "");
  const ProgramRun full = runProgramBetween(arguments, file("empty"), "/dev/full");
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.messages, HasSubstr("irradiff import: cannot write standard output: No space left on device"));
}

TEST_F(Import, LeavesNoFileBehindAFailure) {
  const std::string corners = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n";
  const std::vector<std::pair<std::string, std::string>> models{
      {"", "model.obj: has no faces"},
      {corners + "f 1 2 3 4\n", "model.obj: line 5: polygons[0] \"face 1\": self-intersecting"},
      {"mtllib lamp.mtl\n" + corners + "f 1 2 3\n", "lamp.mtl cannot be opened: No such file or directory"},
      {"mtllib bad.mtl\n" + corners + "f 1 2 3\n", "bad.mtl: line 2: material \"lamp\": Ke: expected a finite number"},
      {corners + "f 1 2 9\n", "model.obj: line 5: face: index 9"},
      {corners + "v nan 0 0\nf 1 2 3\n", "model.obj: line 5: vertex 5: expected a finite number, got \"nan\""},
      {std::string("\x7f"
                   "ELF\0\0\1",
                   7),
       "model.obj: line 1: holds a NUL byte"},
  };
  writeFile(file("bad.mtl"), "newmtl lamp\nKe red\n");
  for (const auto& [model, message] : models) {
    const ProgramRun run = import(model, kInside);
    EXPECT_EQ(run.status, 1) << message;
    EXPECT_EQ(run.output, "");
    EXPECT_THAT(run.messages, AllOf(HasSubstr("irradiff import: "), HasSubstr(message)));
    EXPECT_EQ(scratch_.fileCount(), 3U) << message;  // bad.mtl, box.mtl and model.obj
  }
  writeFile(file("scene.json"), "kept");
  EXPECT_EQ(import("").status, 1);
  EXPECT_EQ(readFile(file("scene.json")), "kept");
}

TEST_F(Import, HasStatusTwoForAWrongCall) {
  writeFile(file("model.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto receiver = [this](const std::string& text) {
    return std::vector<std::string>{"import", file("model.obj"), "--receiver", text};
  };
  const std::vector<std::pair<std::vector<std::string>, std::string>> calls{
      {{"import"}, "FILE is required"},
      {{"import", "/no/such/model.obj"}, "/no/such/model.obj: No such file"},
      {{"import", "/"}, "/ is a folder"},
      {{"import", file("model.obj"), "--output", "/no/such/folder/scene.json"}, "/no/such/folder/scene.json"},
      {{"import", file("model.obj"), "--output", ""}, "--output"},
      {{"import", file("model.obj"), "--points", "1"}, "--points"},
      {receiver("0,0,1"), "\"0,0,1\": has 3 numbers; must be X,Y,Z,NX,NY,NZ"},
      {receiver("0,0,1,0,0,2"), "receiver 0: normal (0, 0, 2) has length 2, must be 1"},
      {receiver("0,0,1,0,0,"), "ends in a comma"},
      {receiver("0,0,1,0,,1"), "expected a finite number, got \"\""},
      {receiver("0,0,nan,0,0,1"), "expected a finite number, got \"nan\""},
      {receiver(""), "--receiver"},
      {receiver("0,0,1,0,0,1,0"), "has 7 numbers"},
  };
  for (const auto& [arguments, message] : calls) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.status, 2) << message;
    EXPECT_EQ(run.output, "") << message;
    EXPECT_THAT(run.messages, HasSubstr(message));
  }
}

TEST_F(Import, TellsItsRulesInItsHelp) {
  const ProgramRun help = runProgram({"import", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.output, AllOf(HasSubstr("--output"), HasSubstr("X,Y,Z,NX,NY,NZ"), HasSubstr("Rec. 709"),
                                 HasSubstr("Exit status")));
}

}  // namespace
}  // namespace irradiff
