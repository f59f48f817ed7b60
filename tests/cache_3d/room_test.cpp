// Rooms as files, and what their cameras see.

#include "experiments/cache_3d/room.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/cache_3d/camera_view.h"
#include "experiments/io/json_text.h"
#include "tests/cache_3d/test_rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <set>
#include <string>

namespace irradiff {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

Json goodRoom() {
  return Json::parse(R"({"format": "irradiff-room", "version": 1, "dimension": 3, "description": "a test",
    "polygons": [{"name": "floor", "vertices": [[0,0,0],[2,0,0],[2,2,0],[0,2,0]], "radiance": 0, "reflectance": 0.5},
                 {"name": "lamp", "vertices": [[0.5,0.5,1],[1,0.5,1],[1,1,1]], "radiance": 3, "reflectance": 0}],
    "camera": {"position": [1,-2,1], "target": [1,1,0], "up": [0,0,1], "field_of_view": 30}})");
}

Room parse(const Json& json) { return parseRoom(json.dump(), "test"); }

TEST(ParseRoom, ReadsAllFields) {
  const Room room = parse(goodRoom());
  EXPECT_EQ(room.name, "test");
  EXPECT_EQ(room.description, "a test");
  ASSERT_EQ(room.polygons.size(), 2U);
  EXPECT_EQ(room.polygons[1].name, "lamp");
  EXPECT_EQ(room.polygons[1].radiance, 3.0);
  EXPECT_EQ(room.polygons[1].vertices[2], Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(room.reflectances, (std::vector<double>{0.5, 0.0}));
  EXPECT_EQ(room.camera.position, Eigen::Vector3d(1, -2, 1));
  EXPECT_EQ(room.camera.target, Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(room.camera.up, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(room.camera.field_of_view, 30.0);
}

TEST(ParseRoom, NamesWhatIsWrong) {
  struct Spoilt {
    std::function<void(Json&)> spoil;
    std::string message;
  };
  const std::vector<Spoilt> cases{
      {[](Json& r) { r["format"] = "irradiff-scene"; }, "format: expected \"irradiff-room\", got \"irradiff-scene\""},
      {[](Json& r) { r["version"] = 2; }, "version: expected 1"},
      {[](Json& r) { r["dimension"] = 2; }, "dimension: expected 3"},
      {[](Json& r) { r["walls"] = 1; }, "unknown field \"walls\""},
      {[](Json& r) { r.erase("camera"); }, "\"camera\" is missing"},
      {[](Json& r) { r["polygons"] = Json::array(); }, "polygons: empty"},
      {[](Json& r) { r["polygons"][0]["reflectance"] = 1.5; },
       "polygons[0] \"floor\": reflectance: is 1.5, must be between 0 and 1"},
      {[](Json& r) { r["polygons"][0]["reflectance"] = -0.1; }, "reflectance: is -0.1, must be between 0 and 1"},
      {[](Json& r) { r["polygons"][0].erase("reflectance"); }, "\"reflectance\" is missing"},
      {[](Json& r) {
         r["polygons"][0]["vertices"][1] = {1, 2};
       },
       "vertices[1]: expected 3 numbers, got 2"},
      {[](Json& r) { r["polygons"][1]["radiance"] = -3; }, "lamp"},
      {[](Json& r) { r["polygons"][1]["radiance"] = 0; }, "no polygon has a radiance above 0"},
      {[](Json& r) { r["polygons"][0]["reflectance"] = 0; }, "no polygon has a reflectance above 0"},
      {[](Json& r) { r["camera"]["position"] = r["camera"]["target"]; }, "target: is the camera's position"},
      {[](Json& r) {
         r["camera"]["up"] = {0, 3, -1};
       },
       "up: is zero or along the direction of view"},
      {[](Json& r) { r["camera"]["field_of_view"] = 180; }, "field_of_view: is 180"},
      {[](Json& r) {
         r["camera"]["target"] = {1, -5, 1};
       },
       "the camera sees no polygon but emitters"},
      {[](Json& r) {
         r["camera"]["position"] = {1.2, 0.7, 0};
       },
       "the camera is on floor"},
  };
  for (const Spoilt& one : cases) {
    Json room = goodRoom();
    one.spoil(room);
    EXPECT_THAT([&] { parse(room); }, ThrowsMessage<std::exception>(HasSubstr(one.message))) << one.message;
  }
  EXPECT_NO_THROW(parse(goodRoom()));
  EXPECT_THAT([] { readRoom("no/such/room.json"); }, ThrowsMessage<std::runtime_error>(HasSubstr("no/such/room.json")));
}

TEST(ReadRoom, ReadsThoseOfData) {
  for (const char* name : {"cornell_box", "cornell_box_black_back_wall", "indirect_penumbra"}) {
    const Room room = dataRoom(name);
    EXPECT_EQ(room.name, name);
    EXPECT_FALSE(room.description.empty());
  }
  const Room box = dataRoom("cornell_box");
  const Room black = dataRoom("cornell_box_black_back_wall");
  ASSERT_EQ(box.polygons.size(), black.polygons.size());
  for (std::size_t i = 0; i < box.polygons.size(); ++i) {
    const bool is_back_wall = box.polygons[i].name == "back wall";
    EXPECT_EQ(black.reflectances[i], is_back_wall ? 0.0 : box.reflectances[i]);
  }
  EXPECT_NE(roomFingerprint(box), roomFingerprint(black));
}

TEST(ReadRoom, HasBlocksThatStandOnTheFloorAndTouchNoWall) {
  const Room box = dataRoom("cornell_box");
  for (const Polygon& polygon : box.polygons) {
    if (polygon.name.find("block") == std::string::npos) continue;
    double lowest = 2.0;
    for (const Eigen::Vector3d& vertex : polygon.vertices) {
      lowest = std::min(lowest, vertex.z());
      EXPECT_GT(vertex.x(), 0.1);
      EXPECT_LT(vertex.x(), 1.9);
      EXPECT_LT(vertex.y(), 1.9);
    }
    EXPECT_EQ(lowest == 0.0, polygon.name.find("side") != std::string::npos) << polygon.name;
  }
}

TEST(CameraProjection, TakesDirectionsToTheirPixels) {
  const Room room = dataRoom("indirect_penumbra");
  const CameraProjection camera(room.camera, 64, 48);
  for (const auto& [column, row] : {std::pair{0.0, 0.0}, {63.0, 0.0}, {17.25, 40.5}, {31.5, 23.5}}) {
    const Eigen::Vector3d point = camera.position() + 3.7 * camera.direction(column, row);
    const std::optional<Eigen::Vector2d> place = camera.place(point);
    ASSERT_TRUE(place);
    EXPECT_NEAR((*place)[0], column, 1e-11);
    EXPECT_NEAR((*place)[1], row, 1e-11);
    // Pixels are as wide as what is between their middles, seen frontally.
    const Eigen::Vector3d next = camera.position() + 3.7 * camera.direction(column + 1.0, row);
    EXPECT_NEAR(camera.pixelSize(point), (next - point).norm(), 1e-13);
  }
  EXPECT_FALSE(camera.place(camera.position() - camera.direction(10, 10)));
  // The middle of the image is the target; up is up, and right is right.
  EXPECT_LT(camera.direction(31.5, 23.5).normalized().cross(room.camera.target - room.camera.position).norm(), 1e-12);
  EXPECT_GT(camera.direction(31.5, 0).z(), camera.direction(31.5, 47).z());
  EXPECT_GT(camera.direction(63, 0).x(), camera.direction(0, 0).x());
}

TEST(SeenPoints, AreOnThePolygonsThatFaceTheCamera) {
  for (const char* name : {"cornell_box", "indirect_penumbra"}) {
    const Room room = dataRoom(name);
    const CameraProjection camera(room.camera, 40, 40);
    const std::vector<SeenPoint> seen = seenPoints(room, 40);
    EXPECT_GT(seen.size(), 700U);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const SeenPoint& point = seen[i];
      if (i > 0) {
        EXPECT_GT(point.pixel, seen[i - 1].pixel);
      }
      EXPECT_EQ(room.polygons[point.polygon].radiance, 0.0);
      EXPECT_LE(point.plane, point.polygon);
      const Eigen::Vector3d offset = point.receiver.position - room.polygons[point.polygon].vertices[0];
      EXPECT_LE(std::abs(offset.dot(point.receiver.normal)), 1e-15);
      EXPECT_GT(point.receiver.normal.dot(camera.position() - point.receiver.position), 0.0);
      const std::size_t row = point.pixel / 40;
      const std::optional<Eigen::Vector2d> place = camera.place(point.receiver.position);
      ASSERT_TRUE(place);
      EXPECT_NEAR((*place)[0], static_cast<double>(point.pixel % 40), 1e-10);
      EXPECT_NEAR((*place)[1], static_cast<double>(row), 1e-10);
    }
  }
}

TEST(SeenPoints, HaveOneNumberForAllOfAPlane) {
  const Room room = dataRoom("cornell_box");
  std::vector<std::string> names;
  for (const SeenPoint& point : seenPoints(room, 40)) {
    if (room.polygons[point.polygon].name.find("ceiling") == std::string::npos) {
      EXPECT_EQ(point.plane, point.polygon);
    } else {
      EXPECT_EQ(room.polygons[point.plane].name, "ceiling, front");
      names.push_back(room.polygons[point.polygon].name);
    }
  }
  EXPECT_GT(std::set<std::string>(names.begin(), names.end()).size(), 3U) << "all four parts are seen";
}

}  // namespace
}  // namespace irradiff
