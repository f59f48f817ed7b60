#include "experiments/io/scene_file.h"

#include "experiments/io/json_fields.h"
#include "experiments/io/scene_fields.h"

#include <string>

namespace irradiff {

namespace {

constexpr std::string_view kFormat = "irradiff-scene";
constexpr int kVersion = 1;

std::vector<Polygon> readPolygons(const JsonField& list) {
  std::vector<Polygon> polygons(list.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto [field, name] = namedElement(list, i, "polygon", {"name", "vertices", "radiance"});
    Polygon& polygon = polygons[i];
    polygon.name = name;
    const JsonField vertices = field.at("vertices");
    polygon.vertices.resize(vertices.size());
    for (std::size_t j = 0; j < polygon.vertices.size(); ++j) polygon.vertices[j] = vectorOf<3>(vertices.at(j));
    polygon.radiance = field.at("radiance").number();
    validate(polygon, i);
  }
  return polygons;
}

std::vector<Segment> readSegments(const JsonField& list) {
  std::vector<Segment> segments(list.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto [field, name] = namedElement(list, i, "segment", {"name", "vertices", "radiance"});
    Segment& segment = segments[i];
    segment.name = name;
    const JsonField vertices = field.at("vertices");
    if (vertices.size() != 2) vertices.refuse("expected 2 vertices, got " + std::to_string(vertices.size()));
    for (std::size_t j = 0; j < 2; ++j) segment.vertices[j] = vectorOf<2>(vertices.at(j));
    segment.radiance = field.at("radiance").number();
    validate(segment, i);
  }
  return segments;
}

void requireReceiverCount(const JsonField& field, std::size_t count) {
  if (count > kMaxReceivers) {
    field.refuse("makes " + std::to_string(count) + " receivers, at most " + std::to_string(kMaxReceivers));
  }
}

template <int Dimension>
std::vector<ReceiverIn<Dimension>> readPoints(const JsonField& list) {
  requireReceiverCount(list, list.size());
  std::vector<ReceiverIn<Dimension>> receivers;
  receivers.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonField point = list.at(i);
    point.requireFields({"position", "normal"});
    receivers.push_back({vectorOf<Dimension>(point.at("position")), vectorOf<Dimension>(point.at("normal"))});
    validate(receivers.back(), i);
  }
  return receivers;
}

ReceiverGrid readGrid(const JsonField& field) {
  field.requireFields({"origin", "u", "v", "resolution", "normal"});
  ReceiverGrid grid;
  grid.origin = vectorOf<3>(field.at("origin"));
  grid.u = vectorOf<3>(field.at("u"));
  grid.v = vectorOf<3>(field.at("v"));
  grid.normal = vectorOf<3>(field.at("normal"));
  const JsonField resolution = field.at("resolution");
  if (resolution.size() != 2) {
    resolution.refuse("expected 2 whole numbers, got " + std::to_string(resolution.size()));
  }
  grid.width = resolution.at(0).positiveInteger();
  grid.height = resolution.at(1).positiveInteger();
  return grid;
}

void appendGrid(const JsonField& field, Scene& scene) {
  const ReceiverGrid grid = readGrid(field);
  std::vector<Receiver>& receivers = scene.receivers;
  const std::size_t count = receivers.size() + grid.width * grid.height;
  requireReceiverCount(field.at("resolution"), count);
  receivers.reserve(count);
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i) {
      receivers.push_back(grid.receiver(i, j));
      validate(receivers.back(), receivers.size() - 1);
    }
  }
  scene.grid = grid;
}

// The fields that say what kind of file this is; returns the dimension.
int readHeader(const JsonField& file) {
  requireFormat(file, kFormat);
  wholeNumberOf(file, "version", {kVersion}, std::to_string(kVersion));
  return wholeNumberOf(file, "dimension", {2, 3}, "2 or 3");
}

}  // namespace

Scene parseScene(std::string_view json_text) {
  const nlohmann::json value = parseJson(json_text);
  const JsonField file = JsonField::whole(value, "scene");
  file.requireObject();
  Scene scene;
  scene.dimension = readHeader(file);
  if (file.has("description")) scene.description = file.at("description").text();
  if (scene.dimension == 3) {
    file.requireFields({"format", "version", "dimension", "polygons", "points", "grid", "description"});
    requireNotEmpty(file.at("polygons"));
    scene.polygons = readPolygons(file.at("polygons"));
    if (file.has("points")) scene.receivers = readPoints<3>(file.at("points"));
    if (file.has("grid")) appendGrid(file.at("grid"), scene);
    if (scene.receivers.empty()) file.refuse("has no receivers, must have \"points\" or a \"grid\"");
  } else {
    file.requireFields({"format", "version", "dimension", "segments", "points", "description"});
    requireNotEmpty(file.at("segments"));
    scene.segments = readSegments(file.at("segments"));
    if (file.has("points")) scene.flatland_receivers = readPoints<2>(file.at("points"));
    if (scene.flatland_receivers.empty()) file.refuse("has no receivers, must have \"points\"");
  }
  return scene;
}

}  // namespace irradiff
