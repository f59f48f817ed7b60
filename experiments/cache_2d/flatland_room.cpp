#include "experiments/cache_2d/flatland_room.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/io/json_fields.h"
#include "experiments/io/scene_fields.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr std::string_view kFormat = "irradiff-room";

void readSegment(const JsonField& list, std::size_t index, FlatlandRoom& room) {
  const auto [field, name] = namedElement(list, index, "segment", {"name", "vertices", "radiance", "reflectance"});
  Segment segment;
  segment.name = name;
  const JsonField vertices = field.at("vertices");
  if (vertices.size() != 2) vertices.refuse("expected 2 vertices, got " + std::to_string(vertices.size()));
  for (std::size_t j = 0; j < 2; ++j) segment.vertices[j] = vectorOf<2>(vertices.at(j));
  segment.radiance = field.at("radiance").number();
  validate(segment, index);
  room.segments.push_back(segment);
  room.reflectances.push_back(reflectanceOf(field));
}

void requireLight(const FlatlandRoom& room) {
  if (std::ranges::none_of(room.segments, [](const Segment& segment) { return segment.radiance > 0.0; })) {
    throw InvalidScene("room " + room.name + ": no segment has a radiance above 0, a black room has no irradiance");
  }
  if (std::ranges::none_of(room.reflectances, [](double reflectance) { return reflectance > 0.0; })) {
    throw InvalidScene("room " + room.name +
                       ": no segment has a reflectance above 0, must have one for light to bounce");
  }
}

}  // namespace

FlatlandRoom parseFlatlandRoom(std::string_view json_text, const std::string& name) {
  const nlohmann::json value = parseJson(json_text);
  const JsonField file = JsonField::whole(value, "room");
  file.requireObject();
  requireFormat(file, kFormat);
  wholeNumberOf(file, "version", {1}, "1");
  wholeNumberOf(file, "dimension", {2}, "2");
  file.requireFields({"format", "version", "dimension", "description", "segments"});
  FlatlandRoom room;
  room.name = name;
  if (file.has("description")) room.description = file.at("description").text();
  const JsonField segments = file.at("segments");
  requireNotEmpty(segments);
  for (std::size_t i = 0; i < segments.size(); ++i) readSegment(segments, i, room);
  requireLight(room);
  return room;
}

FlatlandRoom readFlatlandRoom(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return parseFlatlandRoom(text, path.stem().string());
}

}  // namespace irradiff
