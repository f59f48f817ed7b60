#include "experiments/figures/view_evaluation.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <utility>

namespace irradiff {
namespace {

std::int8_t signOf(double value) { return static_cast<std::int8_t>((value > 0.0) - (value < 0.0)); }

/// The side of the polygon's plane that the receiver is on.
double planeSide(const Polygon& polygon, const Receiver& receiver) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d>& vertices = polygon.vertices;
  for (std::size_t i = 2; i < vertices.size(); ++i) {
    normal += (vertices[i - 1] - vertices[0]).cross(vertices[i] - vertices[0]);
  }
  return normal.dot(receiver.position - vertices[0]);
}

ViewTopology topologyOf(const std::vector<Polygon>& polygons, const Receiver& receiver) {
  ViewTopology topology;
  for (const Polygon& polygon : polygons) {
    topology.push_back(signOf(planeSide(polygon, receiver)));
  }
  return topology;
}

}  // namespace

ViewEvaluator viewEvaluator(std::vector<Polygon> polygons) {
  return [polygons = std::move(polygons)](const Receiver& receiver) {
    return ViewEvaluation{evaluateUnoccluded(polygons, receiver), topologyOf(polygons, receiver)};
  };
}

}  // namespace irradiff
