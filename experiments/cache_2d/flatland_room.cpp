#include "experiments/cache_2d/flatland_room.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/io/json_fields.h"
#include "experiments/io/scene_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr std::string_view kFormat = "irradiff-room";

void requireHeader(const JsonField& file) {
  const JsonField format = file.at("format");
  if (format.text() != kFormat) {
    format.refuse("expected \"" + std::string(kFormat) + "\", got \"" + format.text().substr(0, kMaxNameBytes) + "\"");
  }
  const auto require = [&file](std::string_view name, double expected) {
    const JsonField field = file.at(name);
    if (field.number() != expected) {
      field.refuse("expected " + jsonNumber(expected, name) + ", got " + jsonNumber(field.number(), name));
    }
  };
  require("version", 1);
  require("dimension", 2);
}

std::string readName(const JsonField& segment, std::size_t index) {
  if (!segment.has("name")) return "segment " + std::to_string(index);
  const JsonField name = segment.at("name");
  if (name.text().size() > kMaxNameBytes) {
    name.refuse("has " + std::to_string(name.text().size()) + " bytes, at most " + std::to_string(kMaxNameBytes));
  }
  // A message that quotes it must stay one line, and whole.
  const auto control =
      std::ranges::find_if(name.text(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); });
  if (control != name.text().end()) {
    name.refuse("byte " + std::to_string(control - name.text().begin()) + " is the control character " +
                std::to_string(static_cast<int>(*control)) + ", names must be printable");
  }
  return name.text();
}

Eigen::Vector2d readVertex(const JsonField& field) {
  if (field.size() != 2) field.refuse("expected 2 numbers, got " + std::to_string(field.size()));
  return {field.at(0).number(), field.at(1).number()};
}

void readSegment(const JsonField& unnamed, std::size_t index, FlatlandRoom& room) {
  unnamed.requireFields({"name", "vertices", "radiance", "reflectance"});
  Segment segment;
  segment.name = readName(unnamed, index);
  const JsonField field = unnamed.called(unnamed.path() + " \"" + segment.name + "\"");
  const JsonField vertices = field.at("vertices");
  if (vertices.size() != 2) vertices.refuse("expected 2 vertices, got " + std::to_string(vertices.size()));
  for (std::size_t j = 0; j < 2; ++j) segment.vertices[j] = readVertex(vertices.at(j));
  segment.radiance = field.at("radiance").number();
  validate(segment, index);
  const JsonField reflectance = field.at("reflectance");
  const double value = reflectance.number();
  if (!(value >= 0.0 && value <= 1.0))
    reflectance.refuse("is " + jsonNumber(value, reflectance.path()) + ", must be between 0 and 1");
  room.segments.push_back(segment);
  room.reflectances.push_back(value);
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
  requireHeader(file);
  file.requireFields({"format", "version", "dimension", "description", "segments"});
  FlatlandRoom room;
  room.name = name;
  if (file.has("description")) room.description = file.at("description").text();
  const JsonField segments = file.at("segments");
  if (segments.size() == 0) segments.refuse("empty, expected at least 1");
  for (std::size_t i = 0; i < segments.size(); ++i) readSegment(segments.at(i), i, room);
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
