#include "experiments/cache_3d/room.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/number_text.h"
#include "experiments/cache_3d/camera_view.h"
#include "experiments/io/json_fields.h"
#include "experiments/io/scene_fields.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace irradiff {

namespace {

constexpr std::string_view kFormat = "irradiff-room";
/// Pixels along each side with which the camera looks whether there is anything.
constexpr std::size_t kProbeWidth = 32;

void readPolygon(const JsonField& list, std::size_t index, Room& room) {
  const auto [field, name] = namedElement(list, index, "polygon", {"name", "vertices", "radiance", "reflectance"});
  Polygon& polygon = room.polygons.emplace_back();
  polygon.name = name;
  const JsonField vertices = field.at("vertices");
  for (std::size_t i = 0; i < vertices.size(); ++i) polygon.vertices.push_back(vectorOf<3>(vertices.at(i)));
  polygon.radiance = field.at("radiance").number();
  validate(polygon, index);
  room.reflectances.push_back(reflectanceOf(field));
}

Camera readCamera(const JsonField& field) {
  field.requireFields({"position", "target", "up", "field_of_view"});
  Camera camera;
  camera.position = vectorOf<3>(field.at("position"));
  camera.target = vectorOf<3>(field.at("target"));
  camera.up = vectorOf<3>(field.at("up"));
  camera.field_of_view = field.at("field_of_view").number();
  const Eigen::Vector3d view = camera.target - camera.position;
  if (!(view.norm() > 0.0)) field.at("target").refuse("is the camera's position, must be another point");
  if (!(view.normalized().cross(camera.up.stableNormalized()).norm() > 1e-6)) {
    field.at("up").refuse("is zero or along the direction of view, must be across it");
  }
  if (!(camera.field_of_view > 0.0 && camera.field_of_view < 180.0)) {
    field.at("field_of_view")
        .refuse("is " + jsonNumber(camera.field_of_view, "field_of_view") + " degrees, must be between 0 and 180");
  }
  return camera;
}

/// The polygon that a point lies on, by a ray from just beside it; nothing if there is none.
const Polygon* polygonAt(const Room& room, const Eigen::Vector3d& point) {
  for (const Polygon& polygon : room.polygons) {
    // Angles between vertices seen from a point of the plane add up to a whole turn inside, also where the polygon is
    // not convex.
    const std::size_t count = polygon.vertices.size();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double extent = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      normal += polygon.vertices[i].cross(polygon.vertices[(i + 1) % count]);
      extent = std::max(extent, (polygon.vertices[i] - polygon.vertices[0]).norm());
    }
    normal.normalize();
    if (std::abs(normal.dot(point - polygon.vertices[0])) > 1e-9 * extent) continue;
    double turn = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d a = polygon.vertices[i] - point;
      const Eigen::Vector3d b = polygon.vertices[(i + 1) % count] - point;
      turn += std::atan2(normal.dot(a.cross(b)), a.dot(b));
    }
    if (std::abs(turn) > 3.0) return &polygon;
  }
  return nullptr;
}

void requireLight(const Room& room) {
  if (std::ranges::none_of(room.polygons, [](const Polygon& polygon) { return polygon.radiance > 0.0; })) {
    throw InvalidScene("room " + room.name + ": no polygon has a radiance above 0, a black room has no irradiance");
  }
  if (std::ranges::none_of(room.reflectances, [](double reflectance) { return reflectance > 0.0; })) {
    throw InvalidScene("room " + room.name +
                       ": no polygon has a reflectance above 0, must have one for light to bounce");
  }
}

void requireView(const Room& room) {
  if (const Polygon* polygon = polygonAt(room, room.camera.position)) {
    throw InvalidScene("room " + room.name + ": the camera is on " + polygon->name + ", must be beside all polygons");
  }
  if (seenPoints(room, kProbeWidth).empty()) {
    throw InvalidScene("room " + room.name + ": the camera sees no polygon but emitters in " +
                       std::to_string(kProbeWidth) + " x " + std::to_string(kProbeWidth) +
                       " directions, must see one that may have a record");
  }
}

}  // namespace

Room parseRoom(std::string_view json_text, const std::string& name) {
  const nlohmann::json value = parseJson(json_text);
  const JsonField file = JsonField::whole(value, "room");
  file.requireFields({"format", "version", "dimension", "description", "polygons", "camera"});
  requireFormat(file, kFormat);
  wholeNumberOf(file, "version", {1}, "1");
  wholeNumberOf(file, "dimension", {3}, "3");
  Room room;
  room.name = name;
  if (file.has("description")) room.description = file.at("description").text();
  const JsonField polygons = file.at("polygons");
  requireNotEmpty(polygons);
  for (std::size_t i = 0; i < polygons.size(); ++i) readPolygon(polygons, i, room);
  room.camera = readCamera(file.at("camera"));
  requireLight(room);
  requireView(room);
  return room;
}

Room readRoom(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return parseRoom(text, path.stem().string());
}

std::string roomFingerprint(const Room& room) {
  std::ostringstream text;
  text << std::hexfloat;
  const auto add = [&text](const Eigen::Vector3d& v) { text << v.x() << ' ' << v.y() << ' ' << v.z() << ' '; };
  for (std::size_t i = 0; i < room.polygons.size(); ++i) {
    text << "polygon " << room.polygons[i].radiance << ' ' << room.reflectances[i] << ' ';
    for (const Eigen::Vector3d& vertex : room.polygons[i].vertices) add(vertex);
  }
  text << "camera ";
  add(room.camera.position);
  add(room.camera.target);
  add(room.camera.up);
  text << room.camera.field_of_view;
  return text.str();
}

double extentOf(const Room& room) {
  Eigen::Vector3d low = room.polygons.front().vertices.front();
  Eigen::Vector3d high = low;
  for (const Polygon& polygon : room.polygons) {
    for (const Eigen::Vector3d& vertex : polygon.vertices) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
  }
  return (high - low).maxCoeff();
}

}  // namespace irradiff
