#include "experiments/io/scene_text.h"

#include "experiments/io/json_text.h"
#include "experiments/io/scene_lines.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace irradiff {

namespace {

std::string vectorText(const Eigen::Vector3d& vector, const std::string& field) {
  std::string text = "[";
  for (const double component : vector) text += (text.size() > 1 ? ", " : "") + jsonNumber(component, field);
  return text + ']';
}

std::string textOf(const Polygon& polygon) {
  std::string text = "{\"name\": " + nlohmann::json(polygon.name).dump() + ", \"vertices\": [";
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    if (&vertex != &polygon.vertices.front()) text += ", ";
    text += vectorText(vertex, "vertex");
  }
  return text + "], \"radiance\": " + jsonNumber(polygon.radiance, "radiance") + '}';
}

std::string textOf(const Receiver& receiver) {
  return "{\"position\": " + vectorText(receiver.position, "position") +
         ", \"normal\": " + vectorText(receiver.normal, "normal") + '}';
}

// An array with an element a line, each with what makes it no JSON by itself: a line that is might pass for a scene of
// JSON Lines.
template <class Element>
std::string arrayText(const std::vector<Element>& elements) {
  if (elements.empty()) return "[]";
  std::string text = "[";
  for (const Element& element : elements) {
    text += (&element == &elements.front() ? "\n  " : ",\n  ") + textOf(element);
  }
  return text + ']';
}

// Of the text, as parseJson counts them: numbers, strings, arrays and objects.
std::size_t valueCount(const Scene& scene) {
  std::size_t count = (scene.description.empty() ? 6 : 7) + 9 * scene.receivers.size();
  for (const Polygon& polygon : scene.polygons) count += 4 + 4 * polygon.vertices.size();
  return count;
}

}  // namespace

std::string utf8Text(std::string_view text) {
  const std::string json_text = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(json_text).get<std::string>();
}

std::string sceneText(const Scene& scene) {
  if (const std::size_t count = valueCount(scene); count > kMaxJsonValues) {
    throw SceneFileError("makes a scene of " + std::to_string(count) + " values, at most " +
                         std::to_string(kMaxJsonValues) + " are read");
  }
  std::string text = "{\"format\": \"irradiff-scene\", \"version\": 1, \"dimension\": 3,\n";
  if (!scene.description.empty()) text += " \"description\": " + nlohmann::json(scene.description).dump() + ",\n";
  text += " \"polygons\": " + arrayText(scene.polygons) + ",\n \"points\": " + arrayText(scene.receivers) + "\n}\n";
  if (text.size() > kMaxSceneBytes) {
    throw SceneFileError("makes a scene of " + std::to_string(text.size()) + " bytes, at most " +
                         std::to_string(kMaxSceneBytes) + " are read");
  }
  return text;
}

}  // namespace irradiff
