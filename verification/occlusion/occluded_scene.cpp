#include "verification/occlusion/occluded_scene.h"

#include <array>
#include <charconv>

namespace irradiff {
namespace {

void append(std::string& text, double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), result.ptr);
}

void append(std::string& text, const Eigen::Vector3d& v) {
  text += '[';
  for (int i = 0; i < 3; ++i) {
    text += i > 0 ? "," : "";
    append(text, v(i));
  }
  text += ']';
}

}  // namespace

std::string sceneLine(const OccludedScene& scene) {
  std::string text = R"({"format":"irradiff-scene","version":1,"dimension":3,"polygons":[)";
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    text += i > 0 ? "," : "";
    text += R"({"name":")" + polygon.name + R"(","vertices":[)";
    for (std::size_t v = 0; v < polygon.vertices.size(); ++v) {
      text += v > 0 ? "," : "";
      append(text, polygon.vertices[v]);
    }
    text += R"(],"radiance":)";
    append(text, polygon.radiance);
    text += '}';
  }
  text += R"(],"points":[{"position":)";
  append(text, scene.receiver.position);
  text += R"(,"normal":)";
  append(text, scene.receiver.normal);
  text += "}]}";
  return text;
}

double extentOf(const OccludedScene& scene) {
  Eigen::Vector3d lower = scene.receiver.position;
  Eigen::Vector3d upper = lower;
  for (const Polygon& polygon : scene.polygons) {
    for (const Eigen::Vector3d& v : polygon.vertices) {
      lower = lower.cwiseMin(v);
      upper = upper.cwiseMax(v);
    }
  }
  return (upper - lower).maxCoeff();
}

}  // namespace irradiff
