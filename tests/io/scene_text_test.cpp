#include "experiments/io/scene_text.h"

#include "experiments/io/scene_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>

namespace irradiff {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Scene goodScene() {
  Scene scene;
  scene.description = "a lamp \"L\"";
  scene.polygons = {{"lamp", {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 2.5},
                    {"wall \"K\xC3\xBC"
                     "che\"",
                     {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}},
                     0}};
  scene.receivers = {{{0.25, 0, 0}, {0, 0, 1}}};
  return scene;
}

TEST(SceneText, ReadsBackToTheSameScene) {
  const Scene scene = goodScene();
  const Scene read = parseScene(sceneText(scene));
  EXPECT_EQ(read.dimension, 3);
  EXPECT_EQ(read.description, scene.description);
  ASSERT_EQ(read.polygons.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.polygons[i].name, scene.polygons[i].name);
    EXPECT_EQ(read.polygons[i].vertices, scene.polygons[i].vertices);
    EXPECT_EQ(read.polygons[i].radiance, scene.polygons[i].radiance);
  }
  ASSERT_EQ(read.receivers.size(), 1U);
  EXPECT_EQ(read.receivers[0].position, scene.receivers[0].position);
  EXPECT_EQ(read.receivers[0].normal, scene.receivers[0].normal);
}

TEST(SceneText, KeepsEveryBitOfANumber) {
  std::mt19937_64 random(19);
  Scene scene = goodScene();
  scene.receivers.clear();
  while (scene.receivers.size() < 3000) {
    Eigen::Vector3d position;
    for (double& coordinate : position) coordinate = std::bit_cast<double>(random());
    if (position.allFinite()) scene.receivers.push_back({position, {0, -0.0, 1}});
  }
  const Scene read = parseScene(sceneText(scene));
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(read.receivers[i].position[axis]),
                std::bit_cast<std::uint64_t>(scene.receivers[i].position[axis]));
      ASSERT_EQ(std::signbit(read.receivers[i].normal[axis]), axis == 1);
    }
  }
}

TEST(SceneText, IsOneSceneAmongLinesWhateverItsNames) {
  Scene scene = goodScene();
  for (Polygon& polygon : scene.polygons) polygon.name = "format";
  const std::string text = sceneText(scene);
  std::istringstream stream(text);
  SceneLines lines(stream);
  std::string first;
  ASSERT_TRUE(lines.next(first));
  EXPECT_NO_THROW(parseScene(first));
  EXPECT_FALSE(lines.next(first));
}

TEST(SceneText, HasAPlaceForReceiversThatAreMissing) {
  Scene scene = goodScene();
  scene.receivers.clear();
  std::string text = sceneText(scene);
  EXPECT_THAT([&] { parseScene(text); }, ThrowsMessage<SceneFileError>(HasSubstr("has no receivers")));
  text.replace(text.find("\"points\": []"), 12, R"("points": [{"position": [0, 0, 0], "normal": [0, 0, 1]}])");
  EXPECT_EQ(parseScene(text).receivers.size(), 1U);
}

TEST(SceneText, IsNotWrittenWhereItWouldNotBeRead) {
  Scene many = goodScene();
  // 7 values of the file, 9 of the point, 4 of each polygon and 4 of each of its vertices: brought to the limit.
  many.polygons[0].vertices.resize((kMaxJsonValues - 7 - 9 - 2 * 4 - 4 * 4) / 4, many.polygons[0].vertices[0]);
  EXPECT_NO_THROW(parseJson(sceneText(many)));
  many.polygons[0].vertices.push_back(many.polygons[0].vertices[0]);
  EXPECT_THAT([&] { sceneText(many); },
              ThrowsMessage<SceneFileError>("makes a scene of 4194308 values, at most 4194304 are read"));
  Scene large = goodScene();
  large.description.assign(kMaxSceneBytes, 'x');
  EXPECT_THAT([&] { sceneText(large); }, ThrowsMessage<SceneFileError>(HasSubstr("at most 67108864 are read")));
}

}  // namespace
}  // namespace irradiff
