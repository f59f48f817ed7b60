#include "experiments/io/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A valid scene to be spoilt. The third polygon has a name.
Json goodScene() {
  return Json::parse(R"({"format": "irradiff-scene", "version": 1, "dimension": 3,
    "polygons": [{"vertices": [[0,0,1],[1,0,1],[0,1,1]], "radiance": 1},
                 {"vertices": [[0,0,2],[1,0,2],[0,1,2]], "radiance": 0},
                 {"name": "emitter", "vertices": [[0,0,3],[2,0,3],[2,2,3],[1,0.5,3],[0,2,3]], "radiance": 2.5}],
    "points": [{"position": [0.25,0,0], "normal": [0,0,1]}]})");
}

Json goodFlatScene() {
  return Json::parse(R"({"format": "irradiff-scene", "version": 1, "dimension": 2,
    "segments": [{"name": "lamp", "vertices": [[-1,2],[1,2]], "radiance": 3}, {"vertices": [[5,5],[6,7]], "radiance": 0}],
    "points": [{"position": [0,0.5], "normal": [0,1]}]})");
}

TEST(ParseScene, ReadsPolygonsAndPoints) {
  const Scene scene = parseScene(goodScene().dump());
  EXPECT_EQ(scene.dimension, 3);
  ASSERT_EQ(scene.polygons.size(), 3);
  EXPECT_EQ(scene.polygons[0].name, "polygon 0");
  EXPECT_EQ(scene.polygons[2].name, "emitter");
  EXPECT_EQ(scene.polygons[2].radiance, 2.5);
  ASSERT_EQ(scene.polygons[2].vertices.size(), 5);
  EXPECT_EQ(scene.polygons[2].vertices[3], Eigen::Vector3d(1, 0.5, 3));
  ASSERT_EQ(scene.receivers.size(), 1);
  EXPECT_EQ(scene.receivers[0].position, Eigen::Vector3d(0.25, 0, 0));
  EXPECT_EQ(scene.receivers[0].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_TRUE(scene.segments.empty());
  EXPECT_TRUE(scene.flatland_receivers.empty());
}

TEST(ParseScene, ReadsFlatland) {
  const Scene scene = parseScene(goodFlatScene().dump());
  EXPECT_EQ(scene.dimension, 2);
  ASSERT_EQ(scene.segments.size(), 2);
  EXPECT_EQ(scene.segments[0].name, "lamp");
  EXPECT_EQ(scene.segments[1].name, "segment 1");
  EXPECT_EQ(scene.segments[1].vertices[1], Eigen::Vector2d(6, 7));
  ASSERT_EQ(scene.flatland_receivers.size(), 1);
  EXPECT_EQ(scene.flatland_receivers[0].position, Eigen::Vector2d(0, 0.5));
  EXPECT_TRUE(scene.polygons.empty());
  EXPECT_TRUE(scene.receivers.empty());
}

TEST(ParseScene, PutsAGridBehindThePointsInRowMajorOrder) {
  Json scene = goodScene();
  scene["grid"] =
      Json::parse(R"({"origin": [10,20,0], "u": [4,0,0], "v": [0,6,2], "resolution": [2,3], "normal": [0,1,0]})");
  std::vector<Eigen::Vector3d> positions;
  for (const Receiver& receiver : parseScene(scene.dump()).receivers) positions.push_back(receiver.position);
  ASSERT_EQ(positions.size(), 7);
  EXPECT_EQ(positions[0], Eigen::Vector3d(0.25, 0, 0));
  const std::vector<Eigen::Vector3d> expected{{11, 21, 1.0 / 3}, {13, 21, 1.0 / 3}, {11, 23, 1},
                                              {13, 23, 1},       {11, 25, 5.0 / 3}, {13, 25, 5.0 / 3}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    // Three roundings of numbers up to 25.
    EXPECT_LE((positions[i + 1] - expected[i]).lpNorm<Eigen::Infinity>(), 3 * 16 * 0x1p-52) << i;
  }
  scene.erase("points");
  EXPECT_EQ(parseScene(scene.dump()).receivers.size(), 6);
}

TEST(ParseScene, KeepsTheGridItself) {
  Json scene = goodScene();
  EXPECT_FALSE(parseScene(scene.dump()).grid);
  scene["grid"] =
      Json::parse(R"({"origin": [10,20,0], "u": [4,0,0], "v": [0,6,2], "resolution": [2,3], "normal": [0,1,0]})");
  const Scene read = parseScene(scene.dump());
  ASSERT_TRUE(read.grid);
  EXPECT_EQ(read.grid->origin, Eigen::Vector3d(10, 20, 0));
  EXPECT_EQ(read.grid->u, Eigen::Vector3d(4, 0, 0));
  EXPECT_EQ(read.grid->v, Eigen::Vector3d(0, 6, 2));
  EXPECT_EQ(read.grid->normal, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(read.grid->width, 2);
  EXPECT_EQ(read.grid->height, 3);
  EXPECT_EQ(read.grid->receiver(1, 2).position, read.receivers.back().position);
  EXPECT_EQ(read.grid->receiver(1, 0).position, read.receivers[2].position);
}

TEST(ParseScene, ReadsNumbersBackExactly) {
  std::mt19937_64 random(5);
  const auto number = [&random] {
    for (;;) {
      const double candidate = std::bit_cast<double>(random());
      if (std::isfinite(candidate)) return candidate;
    }
  };
  std::vector<Eigen::Vector3d> positions;
  std::string points;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d position(number(), number(), number());
    points += std::string(i > 0 ? "," : "") + "{\"position\":[" + jsonNumber(position.x(), "x") + "," +
              jsonNumber(position.y(), "y") + "," + jsonNumber(position.z(), "z") + "],\"normal\":[0,0,1]}";
    positions.push_back(position);
  }
  Json scene = goodScene();
  scene["points"] = nullptr;
  std::string text = scene.dump();
  text.replace(text.find("null"), 4, "[" + points + "]");
  const Scene read = parseScene(text);
  ASSERT_EQ(read.receivers.size(), positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(read.receivers[i].position[axis]),
                std::bit_cast<std::uint64_t>(positions[i][axis]));
    }
  }
}

struct Spoilt {
  const char* name;
  std::function<void(Json&)> spoil;
  std::string message;
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest looks for this name.
void PrintTo(const Spoilt& spoilt, std::ostream* stream) { *stream << spoilt.name; }

class SpoiltScene : public testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltScene, IsRefusedByFieldValueAndRule) {
  Json scene = goodScene();
  GetParam().spoil(scene);
  EXPECT_THAT([&] { parseScene(scene.dump()); }, ThrowsMessage<SceneFileError>(HasSubstr(GetParam().message)));
}

class SpoiltFlatScene : public testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltFlatScene, IsRefusedByFieldValueAndRule) {
  Json scene = goodFlatScene();
  GetParam().spoil(scene);
  EXPECT_THAT([&] { parseScene(scene.dump()); }, ThrowsMessage<SceneFileError>(HasSubstr(GetParam().message)));
}

const auto kName = [](const auto& spoilt) { return std::string(spoilt.param.name); };

INSTANTIATE_TEST_SUITE_P(
    Header, SpoiltScene,
    testing::Values(
        Spoilt{"array", [](Json& s) { s = Json::array({s}); }, "scene: expected an object, got an array of 1"},
        Spoilt{"null", [](Json& s) { s = nullptr; }, "scene: expected an object, got null"},
        Spoilt{"no_format", [](Json& s) { s.erase("format"); }, "scene: field \"format\" is missing"},
        Spoilt{"other_format", [](Json& s) { s["format"] = "obj"; },
               "format: expected \"irradiff-scene\", got \"obj\""},
        Spoilt{"format_number", [](Json& s) { s["format"] = 1; }, "format: expected a string, got 1"},
        Spoilt{"no_version", [](Json& s) { s.erase("version"); }, "field \"version\" is missing"},
        Spoilt{"other_version", [](Json& s) { s["version"] = 2; }, "version: expected 1, got 2"},
        Spoilt{"version_text", [](Json& s) { s["version"] = "1"; }, "version: expected a number, got the string \"1\""},
        Spoilt{"no_dimension", [](Json& s) { s.erase("dimension"); }, "field \"dimension\" is missing"},
        Spoilt{"dimension_4", [](Json& s) { s["dimension"] = 4; }, "dimension: expected 2 or 3, got 4"},
        Spoilt{"dimension_2", [](Json& s) { s["dimension"] = 2; },
               "unknown field \"polygons\", must be one of format, version, dimension, segments"},
        Spoilt{"unknown_field", [](Json& s) { s["polygon"] = 1; }, "scene: unknown field \"polygon\""}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    Polygons, SpoiltScene,
    testing::Values(
        Spoilt{"none", [](Json& s) { s.erase("polygons"); }, "field \"polygons\" is missing"},
        Spoilt{"empty", [](Json& s) { s["polygons"] = Json::array(); }, "polygons: empty, expected at least 1"},
        Spoilt{"object", [](Json& s) { s["polygons"] = Json::object(); }, "polygons: expected an array, got an object"},
        Spoilt{"number", [](Json& s) { s["polygons"][1] = 5; }, "polygons[1]: expected an object, got 5"},
        Spoilt{"misspelt_field", [](Json& s) { s["polygons"][2]["radiace"] = 1; },
               "polygons[2]: unknown field \"radiace\", must be one of name, vertices, radiance"},
        Spoilt{"name_control", [](Json& s) { s["polygons"][2]["name"] = std::string("a\0b", 3); },
               "polygons[2]: name: byte 1 is the control character 0, names must be printable"},
        Spoilt{"name_number", [](Json& s) { s["polygons"][2]["name"] = 5; },
               "polygons[2]: name: expected a string, got 5"},
        Spoilt{"name_long", [](Json& s) { s["polygons"][2]["name"] = std::string(1000, 'x'); },
               "polygons[2]: name: has 1000 bytes, at most 256"},
        Spoilt{"no_vertices", [](Json& s) { s["polygons"][2].erase("vertices"); },
               "polygons[2] \"emitter\": field \"vertices\" is missing"},
        Spoilt{"no_radiance", [](Json& s) { s["polygons"][0].erase("radiance"); },
               "polygons[0]: field \"radiance\" is missing"},
        Spoilt{"radiance_null", [](Json& s) { s["polygons"][0]["radiance"] = nullptr; },
               "polygons[0]: radiance: expected a number, got null"},
        Spoilt{"two_components", [](Json& s) { s["polygons"][2]["vertices"][2].erase(2); },
               "polygons[2] \"emitter\": vertices[2]: expected 3 numbers, got 2"},
        Spoilt{"component_text", [](Json& s) { s["polygons"][2]["vertices"][2][1] = "y"; },
               "polygons[2] \"emitter\": vertices[2][1]: expected a number, got the string \"y\""},
        Spoilt{"vertex_number", [](Json& s) { s["polygons"][2]["vertices"][4] = 1; },
               "vertices[4]: expected an array, got 1"}),
    kName);

INSTANTIATE_TEST_SUITE_P(Receivers, SpoiltScene,
                         testing::Values(Spoilt{"none", [](Json& s) { s.erase("points"); },
                                                "scene: has no receivers, must have \"points\" or a \"grid\""},
                                         Spoilt{"empty", [](Json& s) { s["points"] = Json::array(); },
                                                "has no receivers"},
                                         Spoilt{"no_normal", [](Json& s) { s["points"][0].erase("normal"); },
                                                "points[0]: field \"normal\" is missing"},
                                         Spoilt{"unknown_field", [](Json& s) { s["points"][0]["n"] = 1; },
                                                "points[0]: unknown field \"n\", must be one of position, normal"},
                                         Spoilt{"position_2d", [](Json& s) { s["points"][0]["position"].erase(0); },
                                                "points[0]: position: expected 3 numbers, got 2"}),
                         kName);

void addGrid(Json& scene, const std::string& resolution) {
  scene["grid"] = Json::parse(R"({"origin": [0,0,0], "u": [1,0,0], "v": [0,1,0], "normal": [0,0,1]})");
  scene["grid"]["resolution"] = Json::parse(resolution);
}

INSTANTIATE_TEST_SUITE_P(
    Grid, SpoiltScene,
    testing::Values(Spoilt{"zero", [](Json& s) { addGrid(s, "[0,4]"); },
                           "grid: resolution[0]: expected a whole number from 1 to 2^32 - 1, got 0"},
                    Spoilt{"negative", [](Json& s) { addGrid(s, "[4,-1]"); },
                           "grid: resolution[1]: expected a whole number from 1 to 2^32 - 1, got -1"},
                    Spoilt{"fraction", [](Json& s) { addGrid(s, "[4,1.5]"); }, "got 1.5"},
                    Spoilt{"one_number", [](Json& s) { addGrid(s, "[4]"); },
                           "grid: resolution: expected 2 whole numbers, got 1"},
                    Spoilt{"giant", [](Json& s) { addGrid(s, "[100000,100000]"); },
                           "grid: resolution: makes 10000000001 receivers, at most 4194304"},
                    Spoilt{"overflowing", [](Json& s) { addGrid(s, "[4294967295,4294967295]"); }, "at most 4194304"},
                    Spoilt{"beyond_integers", [](Json& s) { addGrid(s, "[1e300,1]"); }, "got 1e+300"},
                    Spoilt{"no_u",
                           [](Json& s) {
                             addGrid(s, "[1,1]");
                             s["grid"].erase("u");
                           },
                           "grid: field \"u\" is missing"},
                    Spoilt{"unknown_field",
                           [](Json& s) {
                             addGrid(s, "[1,1]");
                             s["grid"]["w"] = 1;
                           },
                           "grid: unknown field \"w\""}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    Flatland, SpoiltFlatScene,
    testing::Values(
        Spoilt{"no_segments", [](Json& s) { s.erase("segments"); }, "field \"segments\" is missing"},
        Spoilt{"empty", [](Json& s) { s["segments"] = Json::array(); }, "segments: empty, expected at least 1"},
        Spoilt{"polygons", [](Json& s) { s["polygons"] = 1; }, "unknown field \"polygons\""},
        Spoilt{"grid", [](Json& s) { s["grid"] = 1; }, "unknown field \"grid\""},
        Spoilt{"dimension_3", [](Json& s) { s["dimension"] = 3; }, "unknown field \"segments\""},
        Spoilt{"three_vertices",
               [](Json& s) {
                 s["segments"][0]["vertices"].push_back({0, 0});
               },
               "segments[0] \"lamp\": vertices: expected 2 vertices, got 3"},
        Spoilt{"three_components", [](Json& s) { s["segments"][0]["vertices"][1].push_back(0); },
               "segments[0] \"lamp\": vertices[1]: expected 2 numbers, got 3"},
        Spoilt{"no_points", [](Json& s) { s.erase("points"); }, "scene: has no receivers, must have \"points\""}),
    kName);

// What only `validate` knows arrives as InvalidScene, with the index and name from the file.
class InvalidInFile : public testing::TestWithParam<Spoilt> {};

TEST_P(InvalidInFile, IsRefusedByValidation) {
  Json scene = goodScene();
  GetParam().spoil(scene);
  EXPECT_THAT([&] { parseScene(scene.dump()); }, ThrowsMessage<InvalidScene>(HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, InvalidInFile,
    testing::Values(
        Spoilt{"negative_radiance", [](Json& s) { s["polygons"][2]["radiance"] = -1; },
               "polygons[2] \"emitter\": radiance is -1"},
        Spoilt{"two_vertices", [](Json& s) { s["polygons"][0]["vertices"].erase(2); }, "polygons[0]: has 2 vertices"},
        Spoilt{"not_planar", [](Json& s) { s["polygons"][2]["vertices"][3][2] = 3.5; },
               "polygons[2] \"emitter\": not planar"},
        Spoilt{"bow_tie", [](Json& s) { std::swap(s["polygons"][2]["vertices"][0], s["polygons"][2]["vertices"][1]); },
               "polygons[2] \"emitter\": self-intersecting"},
        Spoilt{"normal", [](Json& s) { s["points"][0]["normal"][2] = 2; }, "receiver 0: normal (0, 0, 2) has length 2"},
        Spoilt{"grid_normal",
               [](Json& s) {
                 addGrid(s, "[1,1]");
                 s["grid"]["normal"][2] = 2;
               },
               "receiver 1: normal (0, 0, 2) has length 2"},
        Spoilt{"grid_beyond_doubles",
               [](Json& s) {
                 addGrid(s, "[2,1]");
                 s["grid"]["origin"][0] = 1.5e308;
                 s["grid"]["u"][0] = 1e308;
               },
               "receiver 2: position (inf, 0.5, 0) is not finite"}),
    kName);

}  // namespace
}  // namespace irradiff
