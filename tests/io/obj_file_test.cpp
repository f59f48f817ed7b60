#include "experiments/io/obj_file.h"

#include "tests/cli/program_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <tiny_obj_loader.h>
#include <vector>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

ObjModel modelOf(const std::string& text, const std::filesystem::path& file = "model.obj") {
  std::istringstream stream(text);
  return readObjFile(stream, file);
}

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjFile, ReadsEveryFormOfAFace) {
  const ObjModel model = modelOf(kCorners +
                                 "vt 0 0\nvn 0 0 1\n"
                                 "f 1 2 3\nf 1/1 2/1 3/1 4/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 4/1/1 # comment\n"
                                 "f -4 -3 -2 -1\nf -1//-1 2 \\\n 3/1\n");
  ASSERT_EQ(model.faces.size(), 6);
  EXPECT_THAT(model.faces[0].vertices, ElementsAre(0, 1, 2));
  EXPECT_THAT(model.faces[1].vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(model.faces[2].vertices, ElementsAre(0, 1, 2));
  EXPECT_THAT(model.faces[3].vertices, ElementsAre(0, 1, 3));
  EXPECT_THAT(model.faces[4].vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(model.faces[5].vertices, ElementsAre(3, 1, 2));
  EXPECT_EQ(model.faces[5].line, 12U);
  EXPECT_EQ(model.vertices[2], Eigen::Vector3d(1, 1, 0));
}

TEST(ObjFile, CountsNegativeIndicesFromTheFaceOn) {
  const ObjModel model = modelOf("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 5 5 5\nf 4 -3 -2\n");
  EXPECT_THAT(model.faces[0].vertices, ElementsAre(0, 1, 2));
  EXPECT_THAT(model.faces[1].vertices, ElementsAre(3, 1, 2));
}

TEST(ObjFile, MayUseAVertexBeforeItIsThere) {
  EXPECT_THAT(modelOf("f 1 2 3\n" + kCorners).faces[0].vertices, ElementsAre(0, 1, 2));
}

TEST(ObjFile, NamesFacesByGroupAndNumber) {
  const std::string face = "f 1 2 3\n";
  const ObjModel model = modelOf(kCorners + face + "o box\n" + face + "g left wall\n" + face + face + "g\n" + face);
  std::vector<std::string> names;
  for (const ObjFace& each : model.faces) names.push_back(each.name);
  EXPECT_THAT(names, ElementsAre("face 1", "box face 2", "left wall face 3", "left wall face 4", "face 5"));
}

TEST(ObjFile, SkipsWhatIsNoFaceAndCountsGeometry) {
  const ObjModel model =
      modelOf("s off\ncstype bezier\n" + kCorners + "vp 0 0\nf 1 2 3\nl 1 2 3\np 1\nsurf 0 1 0 1 1 2\n");
  EXPECT_EQ(model.faces.size(), 1U);
  EXPECT_EQ(model.other_elements, 3U);
}

TEST(ObjFile, HasUpToManyVerticesInAFace) {
  // Beyond 255, where tinyobjloader's own count wraps.
  std::string vertices;
  std::string face = "f";
  for (int i = 1; i <= 300; ++i) {
    vertices += "v " + std::to_string(i) + " 0 0\n";
    face += " " + std::to_string(i);
  }
  EXPECT_EQ(modelOf(vertices + face).faces[0].vertices.size(), 300U);
}

// Doubles as 17 digits, and whether tinyobjloader's own numbers, which are not used, read back to them.
TEST(ObjFile, KeepsSeventeenDigitsWhichTinyobjloaderAloneLoses) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-7, 3);
  std::vector<double> numbers{0.1, 1e-7, 0.12345678901234567, 12345.678901234567, -0.30000000000000004, 1e22, 2.5e-300};
  while (numbers.size() < 3000) numbers.push_back(std::pow(10, exponent(random)));
  std::ostringstream text;
  text.precision(17);
  for (const double number : numbers) text << "v " << number << " 0 0\n";
  text << "f 1 2 3\n";
  const ObjModel model = modelOf(text.str());
  ASSERT_EQ(model.vertices.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(model.vertices[i].x()), std::bit_cast<std::uint64_t>(numbers[i]))
        << numbers[i];
  }

  std::vector<double> others;
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* list, double x, double, double, double) {
    static_cast<std::vector<double>*>(list)->push_back(x);
  };
  std::istringstream stream(text.str());
  tinyobj::LoadObjWithCallback(stream, callbacks, &others);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) lost += others[i] != numbers[i] ? 1 : 0;
  std::cout << lost << " of " << numbers.size() << " numbers of 17 digits are off in tinyobjloader\n";
  EXPECT_GT(lost, 0U);
}

TEST(ObjFile, TakesRadianceFromTheMaterialFileBesideIt) {
  const ScratchFolder scratch;
  writeFile(scratch.file("my room.mtl"), "newmtl lamp\nKe 3 3 3\nnewmtl white wall\nKd 1 1 1\n");
  writeFile(scratch.file("a.mtl"), readFile(scratch.file("my room.mtl")));
  writeFile(scratch.file("more.mtl"), "newmtl sky\nKe 0 0 2\n");
  const std::string faces =
      kCorners + "f 1 2 3\nusemtl lamp\nf 1 2 3\nusemtl white wall\nf 1 2 3\ng x\nusemtl sky\nf 1 2 3\n";
  for (const std::string libraries :
       {"mtllib my room.mtl\nmtllib more.mtl\nmtllib my room.mtl\n", "mtllib more.mtl a.mtl\n"}) {
    const ObjModel model = modelOf(libraries + faces, scratch.file("model.obj"));
    std::vector<double> radiances;
    for (const ObjFace& face : model.faces) radiances.push_back(face.radiance);
    EXPECT_THAT(radiances, ElementsAre(0, 3, 0, 2 * 0.0722)) << libraries;
  }
}

TEST(ObjFile, RefusesAMaterialThatIsNotThere) {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.file("model.obj");
  const auto reading = [&](const std::string& text) {
    return [text, file] { modelOf(text + kCorners + "f 1 2 3", file); };
  };
  EXPECT_THAT(reading("mtllib lamp.mtl\n"),
              ThrowsMessage<ObjFileError>(AllOf(HasSubstr("model.obj: line 1: material file "),
                                                HasSubstr("lamp.mtl cannot be opened: No such file"))));
  EXPECT_THAT(reading("mtllib .\n"), ThrowsMessage<ObjFileError>(HasSubstr("it is a folder")));
  EXPECT_THAT(reading("mtllib\n"), ThrowsMessage<ObjFileError>(HasSubstr("line 1: mtllib has no name")));
  EXPECT_THAT(reading("usemtl lamp\n"),
              ThrowsMessage<ObjFileError>(HasSubstr("line 1: material \"lamp\" is in none of the 0 material files")));
  writeFile(scratch.file("wall.mtl"), "newmtl wall\n");
  EXPECT_NO_THROW(reading("mtllib wall.mtl\nusemtl wall\n")());
  EXPECT_THAT(reading("mtllib wall.mtl\nusemtl lamp\n"),
              ThrowsMessage<ObjFileError>(HasSubstr("line 2: material \"lamp\" is in none of the 1 material files")));
  EXPECT_THAT(reading("usemtl\n"), ThrowsMessage<ObjFileError>(HasSubstr("material \"\" is in none")));
}

struct Refused {
  std::string text;
  std::string message;
};

TEST(ObjFile, RefusesByLineValueAndRule) {
  const std::vector<Refused> files{
      {"", "model.obj: has no faces"},
      {kCorners, "model.obj: has no faces"},
      {"\x89PNG\r\n\x1a\n\xff\xfe garbage", "model.obj: has no faces"},
      {"<html>", "model.obj: has no faces"},
      {"v", "line 1: vertex has 0 numbers, must have at least 3"},
      {"v 0 0 0\nv 1 2", "line 2: vertex has 2 numbers, must have at least 3"},
      {"v 0 0 0\nv 1 nan 0", "line 2: vertex 2: expected a finite number, got \"nan\""},
      {"v 1,5 0 0", "line 1: vertex 1: expected a finite number, got \"1,5\""},
      {"v 0 0 1e999", "line 1: vertex 1: number out of range: \"1e999\", must fit in a double"},
      {kCorners + "f", "line 5: face has 0 vertices, must have at least 3"},
      {kCorners + "f 1 2", "line 5: face has 2 vertices, must have at least 3"},
      {kCorners + "f 1 2 5", "line 5: face: index 5, must be at most 4, the number of vertices in the file"},
      {kCorners + "f 1 2 0", "line 5: face: index \"0\", must be from 1 or from -4 to -1"},
      {kCorners + "f 1 2 -5", "line 5: face: index \"-5\", must be from 1 or from -4 to -1"},
      // 1 in 32 bits.
      {kCorners + "f 4294967297 2 3", "line 5: face: index 4294967297, must be at most 4"},
      {kCorners + "f 99999999999999999999 2 3", "line 5: face: index \"99999999999999999999\", must be"},
      {kCorners + "f 1 2 x", "line 5: face: expected an index such as 7, 7/1, 7//2 or 7/1/2, got \"x\""},
      {kCorners + "f 1 2 3x", "got \"3x\""},
      {kCorners + "f 1 2 3/a", "got \"3/a\""},
      {kCorners + "f 1 2 3.5", "got \"3.5\""},
      {kCorners + "f /1 2 3", "got \"/1\""},
  };
  for (const Refused& refused : files) {
    EXPECT_THAT([&] { modelOf(refused.text); }, ThrowsMessage<ObjFileError>(HasSubstr(refused.message)))
        << refused.text;
  }
}

}  // namespace
}  // namespace irradiff
