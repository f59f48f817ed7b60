#include "tests/figures/event_planes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace irradiff {

EventPlanes::EventPlanes(std::span<const Polygon> polygons, const Eigen::Vector3d& receivers_normal)
    : receivers_normal_(receivers_normal) {
  for (const Polygon& polygon : polygons) {
    const std::vector<Eigen::Vector3d>& vertices = polygon.vertices;
    add(vertices[0], vertices[1], vertices[2]);
    for (const Polygon& other : polygons) {
      for (std::size_t i = 0; &other != &polygon && i < vertices.size(); ++i) {
        for (const Eigen::Vector3d& vertex : other.vertices) {
          add(vertices[i], vertices[(i + 1) % vertices.size()], vertex);
        }
      }
    }
  }
}

double EventPlanes::distance(const Eigen::Vector3d& point) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes_) {
    smallest = std::min(smallest, std::abs(plane.unit_normal.dot(point - plane.point)));
  }
  return smallest;
}

void EventPlanes::add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  // Sine of the angle up to which two planes are parallel.
  constexpr double kParallel = 1e-9;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  // Three points in a line make no plane.
  if (normal.cross(receivers_normal_).norm() > kParallel * normal.norm()) {
    planes_.push_back({a, normal.normalized()});
  }
}

}  // namespace irradiff
