#include "experiments/io/face_polygons.h"

#include "experiments/io/scene_file.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

FacePolygons polygonsOf(const std::string& text) {
  std::istringstream stream(text);
  return facePolygons(readObjFile(stream, "model.obj"));
}

std::vector<std::string> namesOf(const FacePolygons& made) {
  std::vector<std::string> names;
  for (const Polygon& polygon : made.polygons) names.push_back(polygon.name);
  return names;
}

const std::string kCube =
    "o cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(FacePolygons, KeepsPlanarFacesAsTheyAre) {
  const FacePolygons cube = polygonsOf(kCube);
  ASSERT_EQ(cube.polygons.size(), 6U);
  EXPECT_EQ(cube.polygons[3].name, "cube face 4");
  EXPECT_THAT(cube.polygons[3].vertices, ElementsAre(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 1, 0),
                                                     Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 0, 1)));
  // Concave, with a vertex on an edge.
  const FacePolygons arrow = polygonsOf("v 0 0 1\nv 2 -0.5 1\nv 1.9 0 1\nv 2 0.5 1\nv 1 0.25 1\nf 1 2 3 4 5\n");
  EXPECT_EQ(arrow.polygons.at(0).vertices.size(), 5U);
  for (const FacePolygons& made : {cube, arrow}) {
    EXPECT_EQ(made.split_faces + made.triangles + made.dropped_faces + made.dropped_vertices, 0U);
  }
}

TEST(FacePolygons, SplitsWhatTheSceneWouldRefuseAsNotPlanar) {
  // Just inside and just outside of the rule, which is 1e-10 of the extent.
  for (const auto& [height, is_split] : {std::pair("1e-11", false), std::pair("1e-9", true), std::pair("0.5", true)}) {
    const FacePolygons made =
        polygonsOf(std::string("g lamp\nv 0 0 0\nv 1 0 0\nv 2 2 ") + height + "\nv 0 1 0\nf 1 2 3 4\nf 1 2 4\n");
    EXPECT_EQ(made.split_faces, is_split ? 1U : 0U) << height;
    EXPECT_EQ(made.triangles, is_split ? 2U : 0U) << height;
    if (is_split) {
      EXPECT_THAT(namesOf(made), ElementsAre("lamp face 1.1", "lamp face 1.2", "lamp face 2"));
      // At the shorter diagonal.
      EXPECT_EQ(made.polygons[0].vertices[2], Eigen::Vector3d(0, 1, 0));
    } else {
      EXPECT_THAT(namesOf(made), ElementsAre("lamp face 1", "lamp face 2"));
    }
  }
}

TEST(FacePolygons, SplitsAConcaveFaceWithoutChangingWhatItCovers) {
  const FacePolygons made =
      polygonsOf("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 4 1e-6\nv 3 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\nf 1 2 3 4 5 6 7 8\n");
  EXPECT_EQ(made.split_faces, 1U);
  EXPECT_EQ(made.triangles, 6U);
  double area = 0;
  for (const Polygon& triangle : made.polygons) {
    const Eigen::Vector3d& a = triangle.vertices[0];
    area += (triangle.vertices[1] - a).cross(triangle.vertices[2] - a).norm() / 2;
  }
  EXPECT_NEAR(area, 10, 1e-10);  // the vertex off the plane adds less than 1e-12 for each edge; a fan would cover 16
}

TEST(FacePolygons, LeavesOutWhatCoversNothing) {
  const FacePolygons made = polygonsOf(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 1 0 0\n"
      "f 1 2 6 3\nf 1 2 5\nf 1 2 2\nf 1 2 1\nf 1 1 1 1\nf 4 1 2 3 4\n");
  EXPECT_THAT(namesOf(made), ElementsAre("face 1", "face 6"));
  EXPECT_EQ(made.polygons[0].vertices.size(), 3U);
  EXPECT_EQ(made.polygons[1].vertices.size(), 4U);
  EXPECT_EQ(made.dropped_faces, 4U);
  EXPECT_EQ(made.dropped_vertices, 1U + 1U + 1U + 3U + 1U);
  EXPECT_THAT([] { polygonsOf("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"); },
              ThrowsMessage<ObjFileError>("model.obj: none of its 2 faces has an area, at least one must"));
}

TEST(FacePolygons, RefusesAFaceThatMeetsItself) {
  EXPECT_THAT([] { polygonsOf("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\ng bow tie\nf 1 2 3\nf 1 2 3 4\n"); },
              ThrowsMessage<ObjFileError>(AllOf(HasSubstr("model.obj: line 7: polygons[1] \"bow tie face 2\": "),
                                                HasSubstr("self-intersecting: edge 0 from (0, 0, 0) to (1, 1, 0)"))));
  EXPECT_THAT([] { polygonsOf("v 0 0 0\nv 1 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n"); },
              ThrowsMessage<ObjFileError>(AllOf(HasSubstr("model.obj: line 5: polygons[0] \"face 1\": not planar"),
                                                HasSubstr("and it cannot be split into triangles"))));
  EXPECT_THAT([] { polygonsOf("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 1 4\n"); },
              ThrowsMessage<ObjFileError>(HasSubstr("vertex 3 (0, 0, 0) repeats vertex 0")));
}

TEST(FacePolygons, HaveNamesThatASceneFileTakes) {
  const auto nameIn = [](const std::string& group) {
    return polygonsOf("g " + group + "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").polygons.at(0).name;
  };
  EXPECT_EQ(nameIn("K\xC3\xBC"
                   "che"),
            "K\xC3\xBC"
            "che face 1");
  EXPECT_EQ(nameIn("caf\xE9"), "caf\xEF\xBF\xBD face 1");
  for (const std::string piece : {"x", "\xC3\xBC", "\xE9"}) {
    for (std::size_t count = 80; count < 300; ++count) {
      std::string group;
      for (std::size_t i = 0; i < count; ++i) group += piece;
      const std::string name = nameIn(group);
      EXPECT_LE(name.size(), kMaxNameBytes - 6);
      EXPECT_TRUE(name.ends_with(" face 1"));
      EXPECT_NO_THROW(nlohmann::json(name).dump());  // UTF-8
    }
  }
}

// Whatever the bytes: polygons that a scene takes, or an error with a message.
TEST(FacePolygons, OfAnyTextAreValidOrRefused) {
  std::mt19937_64 random(17);
  const std::string good = "mtllib none.mtl\n" + kCube + "g a b\nf -1 -2//1 -3/1/1\nl 1 2\nv .5 6e-1 -.25\nf 1 2 9 4\n";
  const std::string alphabet = "0123456789 -/.evfgo\n\\#nl\xFF";
  std::size_t imported = 0;
  for (int repetition = 0; repetition < 5000; ++repetition) {
    std::string text = good.substr(repetition % 2 == 0 ? 16 : 0);
    const std::size_t changes = 1 + random() % 4;
    for (std::size_t i = 0; i < changes; ++i) text[random() % text.size()] = alphabet[random() % alphabet.size()];
    if (random() % 8 == 0) text.resize(random() % text.size());
    try {
      const FacePolygons made = polygonsOf(text);
      ++imported;
      for (std::size_t i = 0; i < made.polygons.size(); ++i) {
        ASSERT_NO_THROW(validate(made.polygons[i], i)) << text;
      }
    } catch (const ObjFileError& error) {
      ASSERT_THAT(error.what(), HasSubstr("model.obj: ")) << text;
    }
  }
  EXPECT_GT(imported, 100U);
  EXPECT_LT(imported, 4000U);
}

}  // namespace
}  // namespace irradiff
