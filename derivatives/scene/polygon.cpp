#include "derivatives/scene/polygon.h"

#include "derivatives/scene/number_text.h"
#include "derivatives/scene/polygon_plane.h"
#include "derivatives/scene/simple_polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace irradiff {

namespace {

// Writes the errors of one polygon.
class Refusal {
 public:
  Refusal(const Polygon& polygon, std::size_t index) : polygon_(polygon) {
    subject_ = "polygons[" + std::to_string(index) + ']';
    if (!polygon.name.empty() && polygon.name != "polygon " + std::to_string(index))
      subject_ += " \"" + polygon.name + "\"";
  }

  template <class Error = InvalidScene>
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(subject_ + ": " + reason);
  }

  std::string vertex(std::size_t i) const {
    return "vertex " + std::to_string(i) + " " + pointText(polygon_.vertices[i]);
  }

  std::string edge(std::size_t i) const {
    const std::size_t end = (i + 1) % polygon_.vertices.size();
    return "edge " + std::to_string(i) + " from " + pointText(polygon_.vertices[i]) + " to " +
           pointText(polygon_.vertices[end]);
  }

 private:
  const Polygon& polygon_;
  std::string subject_;
};

void requireFiniteData(const Polygon& polygon, const Refusal& refusal) {
  if (!std::isfinite(polygon.radiance) || polygon.radiance < 0) {
    refusal.refuse("radiance is " + numberText(polygon.radiance) + ", must be finite and >= 0");
  }
  if (polygon.vertices.size() < 3) {
    refusal.refuse("has " + std::to_string(polygon.vertices.size()) + " vertices, must have at least 3");
  }
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    if (!polygon.vertices[i].allFinite()) refusal.refuse(refusal.vertex(i) + " is not finite, must be finite");
  }
}

// Two equal points as their indices, the smaller first.
template <class Point>
std::optional<std::pair<std::size_t, std::size_t>> equalPoints(const std::vector<Point>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&points](std::size_t a, std::size_t b) {
    const Point& p = points[a];
    const Point& q = points[b];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  const auto equal = [&points](std::size_t a, std::size_t b) { return points[a] == points[b]; };
  const auto repeated = std::ranges::adjacent_find(order, equal);
  if (repeated == order.end()) return std::nullopt;
  return std::minmax(*repeated, *std::next(repeated));
}

void requireDistinctVertices(const Polygon& polygon, const Refusal& refusal) {
  if (const auto repeated = equalPoints(polygon.vertices)) {
    refusal.refuse(refusal.vertex(repeated->second) + " repeats vertex " + std::to_string(repeated->first) +
                   ", vertices must be distinct");
  }
}

void requireArea(const LocalShape& shape, const Eigen::Vector3d& normal, const Refusal& refusal) {
  // Rounding of the coordinates moves each component of the normal by up to 2 (extent_i ulp_j + extent_j ulp_i).
  const Eigen::Vector3d& extents = shape.extents;
  const Eigen::Vector3d& rounding = shape.rounding;
  const auto from_rounding = [&](int i, int j) { return 2 * (extents[i] * rounding[j] + extents[j] * rounding[i]); };
  const Eigen::Vector3d bound(from_rounding(1, 2), from_rounding(2, 0), from_rounding(0, 1));
  if ((normal.array().abs() <= bound.array()).all()) {
    refusal.refuse<PolygonWithoutArea>("has no area: all " + std::to_string(shape.vertices.size()) +
                                       " vertices are on one line to within the rounding of their coordinates");
  }
}

void requirePlane(const LocalShape& shape, const Eigen::Vector3d& normal, const Refusal& refusal) {
  const Eigen::Vector3d unit_normal = (normal / normal.lpNorm<Eigen::Infinity>()).normalized();
  const double tolerance = kPlanarityTolerance * shape.extent + kPlanarityRounding * shape.largest_coordinate;
  double largest_distance = 0;
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    const double distance = std::abs(unit_normal.dot(shape.vertices[i]));
    if (distance > largest_distance) {
      largest_distance = distance;
      farthest = i;
    }
  }
  if (largest_distance > tolerance) {
    refusal.refuse<NonPlanarPolygon>(
        "not planar: " + refusal.vertex(farthest) + " is " + numberText(std::ldexp(largest_distance, shape.exponent)) +
        " m from the plane of the polygon, must be within " + numberText(std::ldexp(tolerance, shape.exponent)) +
        " m (" + numberText(kPlanarityTolerance) + " of its extent + 2^-49 of its largest coordinate)");
  }
}

void requireSimple(const Polygon& polygon, const Eigen::Vector3d& normal, const Refusal& refusal) {
  const std::vector<Eigen::Vector2d> projected = projection(polygon.vertices, normal);
  if (const auto coincident = equalPoints(projected)) {
    refusal.refuse("self-intersecting: " + refusal.vertex(coincident->second) + " coincides in the plane with " +
                   refusal.vertex(coincident->first) + ", vertices must be distinct");
  }
  if (const auto meeting = meetingEdges(projected)) {
    refusal.refuse("self-intersecting: " + refusal.edge(meeting->first) + " meets " + refusal.edge(meeting->second) +
                   ", edges must meet in common vertices only");
  }
}

}  // namespace

void validate(const Polygon& polygon, std::size_t index) {
  const Refusal refusal(polygon, index);
  requireFiniteData(polygon, refusal);
  requireDistinctVertices(polygon, refusal);
  const LocalShape shape = localShape(polygon.vertices);
  const Eigen::Vector3d normal = widestNormal(shape.vertices);
  requireArea(shape, normal, refusal);
  requirePlane(shape, normal, refusal);
  requireSimple(polygon, normal, refusal);
}

}  // namespace irradiff
