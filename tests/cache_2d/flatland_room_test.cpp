#include "experiments/cache_2d/flatland_room.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/io/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace irradiff {
namespace {

using testing::HasSubstr;

std::string roomText(const std::string& segments, const std::string& dimension = "2") {
  return R"({"format": "irradiff-room", "version": 1, "dimension": )" + dimension + R"(, "segments": [)" + segments +
         "]}";
}

const std::string kLamp = R"({"name": "lamp", "vertices": [[0, 2], [1, 2]], "radiance": 3, "reflectance": 0})";
const std::string kFloor = R"({"name": "floor", "vertices": [[0, 0], [1, 0]], "radiance": 0, "reflectance": 0.5})";

std::string messageOf(const std::string& text) {
  try {
    parseFlatlandRoom(text, "test");
  } catch (const SceneFileError& error) {
    return error.what();
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "read";
}

TEST(FlatlandRoom, IsReadAsWritten) {
  const FlatlandRoom room = parseFlatlandRoom(roomText(kLamp + "," + kFloor), "test");
  ASSERT_EQ(room.segments.size(), 2u);
  EXPECT_EQ(room.name, "test");
  EXPECT_EQ(room.segments[0].name, "lamp");
  EXPECT_EQ(room.segments[0].radiance, 3.0);
  EXPECT_EQ(room.segments[1].vertices[1], Eigen::Vector2d(1.0, 0.0));
  EXPECT_THAT(room.reflectances, testing::ElementsAre(0.0, 0.5));
}

TEST(FlatlandRoom, PublishedRoomsAreNamedByTheirFiles) {
  for (const std::string name : {"flatland_lamp", "flatland_slot"}) {
    EXPECT_EQ(readFlatlandRoom("data/rooms/" + name + ".json").name, name);
  }
}

TEST(FlatlandRoom, BadInputIsNamedWithValueAndRule) {
  const auto lampWith = [](const std::string& what, const std::string& by) {
    std::string text = kLamp;
    return roomText(text.replace(text.find(what), what.size(), by) + "," + kFloor);
  };
  EXPECT_EQ(messageOf(lampWith("\"reflectance\": 0", "\"reflectance\": 1.5")),
            "segments[0] \"lamp\": reflectance: is 1.5, must be between 0 and 1");
  EXPECT_EQ(messageOf(lampWith("\"reflectance\": 0", "\"reflectance\": -0.25")),
            "segments[0] \"lamp\": reflectance: is -0.25, must be between 0 and 1");
  EXPECT_THAT(messageOf(lampWith(", \"reflectance\": 0", "")), HasSubstr("field \"reflectance\" is missing"));
  EXPECT_THAT(messageOf(lampWith("\"radiance\": 3", "\"radiance\": -3")), HasSubstr("radiance"));
  EXPECT_THAT(messageOf(lampWith("[1, 2]", "[1, 2, 0]")), HasSubstr("expected 2 numbers, got 3"));
  EXPECT_THAT(messageOf(lampWith("[1, 2]", "[0, 2]")), HasSubstr("segments[0] \"lamp\""));
  EXPECT_THAT(messageOf(lampWith("\"name\"", "\"colour\"")), HasSubstr("unknown field \"colour\""));
  EXPECT_EQ(messageOf(lampWith("\"radiance\": 3", "\"radiance\": 0")),
            "room test: no segment has a radiance above 0, a black room has no irradiance");
  EXPECT_EQ(messageOf(roomText(kLamp)),
            "room test: no segment has a reflectance above 0, must have one for light to bounce");
  EXPECT_EQ(messageOf(roomText("")), "segments: empty, expected at least 1");
  EXPECT_EQ(messageOf(roomText(kLamp + "," + kFloor, "3")), "dimension: expected 2, got 3");
  EXPECT_THAT(messageOf(R"({"format": "irradiff-scene"})"), HasSubstr("expected \"irradiff-room\""));
  EXPECT_EQ(messageOf(roomText(kLamp + "," + kFloor)), "read");
  EXPECT_THROW(readFlatlandRoom("data/rooms/no_such_room.json"), std::runtime_error);
}

}  // namespace
}  // namespace irradiff
