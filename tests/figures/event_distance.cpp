#include "tests/figures/event_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace irradiff {
namespace {

/// Sine of the angle up to which two planes are parallel.
constexpr double kParallel = 1e-9;

double planeDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                     const Receiver& receiver) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  // Three points in a line make no plane, and a plane along the receivers' own is crossed nowhere in that.
  const bool is_crossed = normal.cross(receiver.normal).norm() > kParallel * normal.norm();
  return is_crossed ? std::abs(normal.dot(receiver.position - a)) / normal.norm()
                    : std::numeric_limits<double>::infinity();
}

}  // namespace

double eventDistance(std::span<const Polygon> polygons, const Receiver& receiver) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Polygon& polygon : polygons) {
    const std::vector<Eigen::Vector3d>& vertices = polygon.vertices;
    smallest = std::min(smallest, planeDistance(vertices[0], vertices[1], vertices[2], receiver));
    for (const Polygon& other : polygons) {
      if (&other == &polygon) {
        continue;
      }
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (const Eigen::Vector3d& vertex : other.vertices) {
          smallest =
              std::min(smallest, planeDistance(vertices[i], vertices[(i + 1) % vertices.size()], vertex, receiver));
        }
      }
    }
  }
  return smallest;
}

}  // namespace irradiff
