#pragma once

// Included by the sources of this folder alone: it includes CGAL.

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/number_text.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace irradiff::exact {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Vector = Kernel::Vector_3;

inline Vector exactVector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Vector cross(const Vector& a, const Vector& b) { return CGAL::cross_product(a, b); }
/// The axis of the largest component.
inline int largestAxis(const Vector& v) {
  int largest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (CGAL::abs(v[axis]) > CGAL::abs(v[largest])) largest = axis;
  }
  return largest;
}
inline bool isZero(const Vector& v) { return v == CGAL::NULL_VECTOR; }

/// A polygon relative to the receiver, which is not in its plane.
class ViewedPolygon {
 public:
  /// `area` is the sum of v_i x v_{i+1}, so the vertices run counterclockwise about it.
  ViewedPolygon(std::size_t index, double radiance, std::vector<Vector> vertices, const Vector& area)
      : index_(index), radiance_(radiance), vertices_(std::move(vertices)), area_(area), dropped_(largestAxis(area)) {
    const Number offset = area_ * vertices_[0];
    inverse_depth_ = area_ / offset;
    interior_on_right_ = offset > 0;
    for (const Vector& vertex : vertices_) outline_.push_back(inPlane(vertex));
  }

  std::size_t index() const { return index_; }
  double radiance() const { return radiance_; }
  const std::vector<Vector>& vertices() const { return vertices_; }
  const Vector& vertexAfter(std::size_t i) const { return vertices_[(i + 1) % vertices_.size()]; }
  const Vector& area() const { return area_; }

  /// The direction w meets the plane at w / (inverseDepth().w), in front of the receiver where that is positive.
  const Vector& inverseDepth() const { return inverse_depth_; }
  /// Negative on the receiver's side of the plane, 0 in it.
  Number behind(const Vector& point) const { return inverse_depth_ * point - 1; }

  /// For a point in the plane.
  CGAL::Bounded_side sideOf(const Vector& point) const {
    return CGAL::bounded_side_2(outline_.begin(), outline_.end(), inPlane(point), Kernel());
  }

  bool hasStrictlyInside(const Vector& direction) const {
    const Number inverse = inverse_depth_ * direction;
    return inverse > 0 && sideOf(direction / inverse) == CGAL::ON_BOUNDED_SIDE;
  }

  /// Whether direction + epsilon step is in the image for small positive epsilon. Requires that the direction meets no
  /// vertex and the step leaves every edge that it meets. A direction along the plane meets it at no finite distance.
  bool covers(const Vector& direction, const Vector& step) const {
    const Number inverse = inverse_depth_ * direction;
    if (inverse <= 0) return false;
    const Vector point = direction / inverse;
    const CGAL::Bounded_side side = sideOf(point);
    if (side != CGAL::ON_BOUNDARY) return side == CGAL::ON_BOUNDED_SIDE;
    const std::size_t edge = edgeAt(point);
    const Vector right = cross(vertices_[edge], vertexAfter(edge));
    return (right * step > 0) == interior_on_right_;
  }

 private:
  using Point2 = Kernel::Point_2;

  // Without the coordinate in which the plane is steepest.
  Point2 inPlane(const Vector& point) const { return {point[(dropped_ + 1) % 3], point[(dropped_ + 2) % 3]}; }

  std::size_t edgeAt(const Vector& point) const {
    const Point2 place = inPlane(point);
    std::size_t edge = 0;
    while (!Kernel::Segment_2(outline_[edge], outline_[(edge + 1) % outline_.size()]).has_on(place)) ++edge;
    return edge;
  }

  std::size_t index_;
  double radiance_;
  std::vector<Vector> vertices_;
  Vector area_;
  Vector inverse_depth_;
  bool interior_on_right_;
  int dropped_;
  std::vector<Point2> outline_;
};

/// The pieces of the crease between two polygons, those in the interior of both, as their end points in the order of
/// a.area() x b.area().
inline std::vector<std::pair<Vector, Vector>> creases(const ViewedPolygon& a, const ViewedPolygon& b) {
  const Vector along = cross(a.area(), b.area());
  if (isZero(along)) return {};
  std::vector<Vector> cuts;
  for (const auto& [polygon, other] : {std::pair{&a, &b}, {&b, &a}}) {
    bool before = false;
    bool after = false;
    for (std::size_t i = 0; i < polygon->vertices().size(); ++i) {
      const Vector& first = polygon->vertices()[i];
      const Number from = other->behind(first);
      const Number to = other->behind(polygon->vertexAfter(i));
      before = before || from < 0;
      after = after || from > 0;
      if (from == 0) cuts.push_back(first);
      if (CGAL::sign(from) * CGAL::sign(to) < 0) {
        cuts.push_back(first + (polygon->vertexAfter(i) - first) * (from / (from - to)));
      }
    }
    if (!before || !after) return {};
  }
  std::ranges::sort(cuts, [&along](const Vector& p, const Vector& q) { return along * (q - p) > 0; });

  std::vector<std::pair<Vector, Vector>> pieces;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i] == cuts[i + 1]) continue;
    const Vector middle = (cuts[i] + cuts[i + 1]) / 2;
    if (a.sideOf(middle) == CGAL::ON_BOUNDED_SIDE && b.sideOf(middle) == CGAL::ON_BOUNDED_SIDE) {
      pieces.emplace_back(cuts[i], cuts[i + 1]);
    }
  }
  return pieces;
}

/// Polygons and receiver as rational numbers, the receiver at the origin.
class ExactScene {
 public:
  /// Throws InvalidScene; see exactVisibility().
  ExactScene(const std::vector<Polygon>& polygons, const Receiver& receiver) : place_(polygons.size()) {
    validate(receiver, 0);
    position_ = exactVector(receiver.position);
    normal_ = exactVector(receiver.normal);
    for (std::size_t index = 0; index < polygons.size(); ++index) {
      validate(polygons[index], index);
      names_.push_back("polygons[" + std::to_string(index) + "] \"" + polygons[index].name + "\"");
      std::vector<Vector> vertices;
      for (const Eigen::Vector3d& vertex : polygons[index].vertices) {
        vertices.push_back(exactVector(vertex) - position_);
      }
      const Vector area = areaOf(vertices);
      requirePlane(polygons[index], index, vertices, area);
      if (area * vertices[0] == 0) {
        edge_on_.push_back(index);
      } else {
        place_[index] = polygons_.size();
        polygons_.emplace_back(index, polygons[index].radiance, std::move(vertices), area);
      }
    }
  }

  const Vector& position() const { return position_; }
  const Vector& normal() const { return normal_; }
  /// Those that are not edge-on.
  const std::vector<ViewedPolygon>& polygons() const { return polygons_; }
  const ViewedPolygon& polygon(std::size_t index) const { return polygons_[place_[index]]; }
  const std::vector<std::size_t>& edgeOn() const { return edge_on_; }

  /// The nearest polygon in direction + epsilon step for small positive epsilon, or nothing; requires what
  /// ViewedPolygon::covers does. Throws InvalidScene when two coplanar polygons of different radiance are nearest.
  std::optional<std::size_t> frontMost(const Vector& direction, const Vector& step) const {
    const ViewedPolygon* nearest = nullptr;
    const ViewedPolygon* rival = nullptr;
    for (const ViewedPolygon& polygon : polygons_) {
      if (!polygon.covers(direction, step)) continue;
      CGAL::Sign nearer = CGAL::POSITIVE;
      if (nearest != nullptr) {
        const Vector difference = polygon.inverseDepth() - nearest->inverseDepth();
        nearer = CGAL::sign(difference * direction);
        // They meet in this direction.
        if (nearer == CGAL::ZERO) nearer = CGAL::sign(difference * step);
      }
      if (nearer == CGAL::POSITIVE) {
        nearest = &polygon;
        rival = nullptr;
      } else if (nearer == CGAL::ZERO && rival == nullptr && polygon.radiance() != nearest->radiance()) {
        rival = &polygon;
      }
    }
    if (nearest == nullptr) return std::nullopt;
    if (rival != nullptr) {
      throw InvalidScene(names_[rival->index()] + ": of radiance " + numberText(rival->radiance()) +
                         " overlaps in one plane with " + names_[nearest->index()] + " of radiance " +
                         numberText(nearest->radiance()) +
                         ", and both are nearest to the receiver; must be equal there");
    }
    return nearest->index();
  }

  /// Whether another polygon in the plane of this one is front-most instead wherever both cover a direction, and has
  /// this direction strictly inside its image: an edge there separates nothing.
  bool isCoveredInItsPlane(std::size_t index, const Vector& direction) const {
    return std::ranges::any_of(polygons_, [&](const ViewedPolygon& other) {
      return other.index() < index && other.inverseDepth() == polygon(index).inverseDepth() &&
             other.hasStrictlyInside(direction);
    });
  }

 private:
  static Vector areaOf(const std::vector<Vector>& vertices) {
    Vector area = CGAL::NULL_VECTOR;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
      area = area + cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
    }
    return area;
  }

  void requirePlane(const Polygon& polygon, std::size_t index, const std::vector<Vector>& vertices,
                    const Vector& area) const {
    for (std::size_t i = 3; i < vertices.size(); ++i) {
      const Number volume = area * (vertices[i] - vertices[0]);
      if (volume == 0) continue;
      // For the message alone.
      const double distance = std::abs(CGAL::to_double(volume)) / std::sqrt(CGAL::to_double(area * area));
      throw InvalidScene(names_[index] + ": vertex " + std::to_string(i) + ' ' + pointText(polygon.vertices[i]) +
                         " is about " + numberText(distance) +
                         " m from the plane of its polygon, must be exactly in it");
    }
  }

  std::vector<std::string> names_;
  Vector position_;
  Vector normal_;
  std::vector<ViewedPolygon> polygons_;
  std::vector<std::size_t> place_;  // in polygons_
  std::vector<std::size_t> edge_on_;
};

}  // namespace irradiff::exact
