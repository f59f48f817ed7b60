#include "verification/occlusion/occluded_scene.h"

#include "verification/checks/json_point.h"

namespace irradiff {

std::string sceneLine(const OccludedScene& scene) {
  std::string text = R"({"format":"irradiff-scene","version":1,"dimension":3,"polygons":[)";
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    text += i > 0 ? "," : "";
    text += R"({"name":")" + polygon.name + R"(","vertices":[)";
    for (std::size_t v = 0; v < polygon.vertices.size(); ++v) {
      text += v > 0 ? "," : "";
      appendPoint(text, polygon.vertices[v]);
    }
    text += R"(],"radiance":)";
    appendNumber(text, polygon.radiance);
    text += '}';
  }
  text += R"(],"points":[{"position":)";
  appendPoint(text, scene.receiver.position);
  text += R"(,"normal":)";
  appendPoint(text, scene.receiver.normal);
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
