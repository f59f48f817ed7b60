#include "derivatives/scene/polygon.h"

#include "derivatives/scene/number_text.h"
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

using Vertices = std::vector<Eigen::Vector3d>;

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

// Exponent k of the scaling x -> x 2^-k that brings `largest` into [1/2, 1).
int scalingExponent(double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

double scaled(double value, int exponent) { return std::ldexp(value, -exponent); }

Eigen::Vector3d scaled(const Eigen::Vector3d& vector, int exponent) {
  return {scaled(vector.x(), exponent), scaled(vector.y(), exponent), scaled(vector.z(), exponent)};
}

// The vertices relative to the first one, scaled by a power of two so that the extent is in [1/2, 1).
struct LocalShape {
  Vertices vertices;
  Eigen::Vector3d extents = Eigen::Vector3d::Zero();   // largest difference between two vertices along each axis
  double extent = 0;                                   // the largest of them
  Eigen::Vector3d rounding = Eigen::Vector3d::Zero();  // at most one ulp of the largest coordinate along each axis
  double largest_coordinate = 0;                       // of the vertices before the translation
  int exponent = 0;                                    // in metres, all of this is 2^exponent times larger
};

LocalShape localShape(const Vertices& vertices) {
  double largest_coordinate = 0;
  for (const Eigen::Vector3d& vertex : vertices) {
    largest_coordinate = std::max(largest_coordinate, vertex.lpNorm<Eigen::Infinity>());
  }
  // In two steps: differences between the largest doubles overflow, those between the smallest lose nothing.
  LocalShape shape;
  shape.exponent = scalingExponent(largest_coordinate);
  shape.vertices = vertices;
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(1);
  Eigen::Vector3d upper = -lower;
  for (Eigen::Vector3d& vertex : shape.vertices) {
    vertex = scaled(vertex, shape.exponent);
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  const Eigen::Vector3d first = shape.vertices.front();
  const int extent_exponent = scalingExponent((upper - lower).maxCoeff());
  for (Eigen::Vector3d& vertex : shape.vertices) vertex = scaled(vertex - first, extent_exponent);
  shape.extents = scaled(upper - lower, extent_exponent);
  shape.extent = shape.extents.maxCoeff();
  shape.rounding = scaled(0x1p-52 * lower.cwiseAbs().cwiseMax(upper.cwiseAbs()), extent_exponent);
  shape.largest_coordinate = scaled(scaled(largest_coordinate, shape.exponent), extent_exponent);
  shape.exponent += extent_exponent;
  return shape;
}

// a d - b c with a relative error of 1.5 ulp (Kahan).
double differenceOfProducts(double a, double d, double b, double c) {
  const double product = b * c;
  const double product_error = std::fma(-b, c, product);
  return std::fma(a, d, -product) + product_error;
}

Eigen::Vector3d accurateCross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {differenceOfProducts(a.y(), b.z(), a.z(), b.y()), differenceOfProducts(a.z(), b.x(), a.x(), b.z()),
          differenceOfProducts(a.x(), b.y(), a.y(), b.x())};
}

double length(const Eigen::Vector3d& v) { return std::hypot(v.x(), v.y(), v.z()); }

// Normal of the widest triangle (twice its area long): the first vertex, the one farthest from it, and the one farthest
// from the line through both.
Eigen::Vector3d widestNormal(const Vertices& local) {
  const auto shorter = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return length(a) < length(b); };
  const Eigen::Vector3d along = *std::ranges::max_element(local, shorter);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : local) {
    const Eigen::Vector3d candidate = accurateCross(along, vertex);
    if (length(candidate) > length(normal)) normal = candidate;
  }
  return normal;
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

// The polygon without the coordinate in which its plane is steepest; each axis scaled by its own power of two, which
// keeps all orientations.
std::vector<Eigen::Vector2d> projection(const Vertices& vertices, const Eigen::Vector3d& normal) {
  constexpr double kNegligible = 0x1p-480;
  Eigen::Index dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const std::array<Eigen::Index, 2> kept{(dropped + 1) % 3, (dropped + 2) % 3};
  std::vector<Eigen::Vector2d> projected(vertices.size());
  for (int axis = 0; axis < 2; ++axis) {
    double largest = 0;
    for (const Eigen::Vector3d& vertex : vertices) largest = std::max(largest, std::abs(vertex[kept[axis]]));
    const int exponent = scalingExponent(largest) - 480;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const double coordinate = scaled(vertices[i][kept[axis]], exponent);
      projected[i][axis] = std::abs(coordinate) < kNegligible ? 0.0 : coordinate;
    }
  }
  return projected;
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
