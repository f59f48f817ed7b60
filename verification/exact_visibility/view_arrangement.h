#pragma once

// Included by the sources of this folder alone: it includes CGAL.

#include "verification/exact_visibility/exact_scene.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_linear_traits_2.h>
#include <CGAL/Arrangement_2.h>

#include <array>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace irradiff::exact {

/// A point relative to the receiver, above the horizon or on it.
struct ViewPoint {
  Vector position;
  bool on_horizon = false;
};

/// The part of a line piece start + t along, 0 <= t <= 1, that is above the horizon.
struct ViewCurve {
  SceneLine line;
  Vector start;
  Vector along;
  std::size_t source = 0;  // its ends, of which at most one is on the horizon
  std::size_t target = 0;

  /// Normal of the curve's plane through the receiver, on the right of the line.
  Vector right() const { return cross(start, along); }
  /// t of the point in a direction that the curve is seen in.
  Number parameter(const Vector& direction) const {
    const Vector side = right();
    return (cross(start, direction) * side) / (cross(direction, along) * side);
  }
};

/// A piece of one or more curves, without another curve across it.
struct ViewEdge {
  std::size_t source = 0;  // vertices of the view
  std::size_t target = 0;
  std::vector<std::size_t> curves;
  std::size_t right_face = 0;  // as seen from the receiver, from source to target
  std::size_t left_face = 0;
};

/// All curves as seen from the receiver, cut where they cross. A vertex on the horizon belongs to one edge.
struct View {
  std::vector<ViewPoint> vertices;
  std::vector<ViewEdge> edges;
  std::size_t faces = 0;
};

/// The arrangement of the curves in the plane n.w = 1, on which directions are projected from the receiver; what ends
/// on the horizon becomes a ray.
class ProjectionPlane {
 public:
  explicit ProjectionPlane(const Vector& normal) : normal_(normal) {
    for (int axis = 1; axis < 3; ++axis) {
      if (CGAL::abs(normal[axis]) > CGAL::abs(normal[dropped_])) dropped_ = axis;
    }
    // So that the plane's counterclockwise side is the right side as seen from the receiver.
    if (normal[dropped_] < 0) std::swap(first_, second_);
  }

  View arrange(const std::vector<ViewPoint>& points, const std::vector<ViewCurve>& curves) const {
    std::vector<Point2> projected;
    for (const ViewPoint& point : points) projected.push_back(project(point));
    std::vector<Curve2> projected_curves;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      std::size_t from = curves[i].source;
      std::size_t to = curves[i].target;
      if (points[from].on_horizon) std::swap(from, to);
      const Point2& origin = projected[from];
      if (points[to].on_horizon) {
        projected_curves.emplace_back(Kernel::Ray_2(origin, projected[to] - CGAL::ORIGIN), i);
      } else {
        projected_curves.emplace_back(Kernel::Segment_2(origin, projected[to]), i);
      }
    }
    Arrangement arrangement;
    CGAL::insert(arrangement, projected_curves.begin(), projected_curves.end());
    return viewOf(arrangement);
  }

 private:
  using Traits = CGAL::Arr_consolidated_curve_data_traits_2<CGAL::Arr_linear_traits_2<Kernel>, std::size_t>;
  using Dcel = CGAL::Arr_extended_dcel<Traits, std::size_t, std::monostate, std::size_t>;
  using Arrangement = CGAL::Arrangement_2<Traits, Dcel>;
  using Point2 = Kernel::Point_2;
  using Curve2 = Traits::Curve_2;

  // A direction on the horizon is projected to that of its ray.
  Point2 project(const ViewPoint& point) const {
    const Vector& w = point.position;
    const Number height = point.on_horizon ? Number(1) : normal_ * w;
    return {w[axis(first_)] / height, w[axis(second_)] / height};
  }

  Vector direction(const Number& s, const Number& t, bool on_horizon) const {
    std::array<Number, 3> w;
    w[axis(first_)] = s;
    w[axis(second_)] = t;
    const Number rest = normal_[axis(first_)] * s + normal_[axis(second_)] * t;
    w[dropped_] = ((on_horizon ? 0 : 1) - rest) / normal_[dropped_];
    return {w[0], w[1], w[2]};
  }

  View viewOf(Arrangement& arrangement) const {
    View view;
    for (auto vertex = arrangement.vertices_begin(); vertex != arrangement.vertices_end(); ++vertex) {
      vertex->set_data(view.vertices.size());
      view.vertices.push_back({direction(vertex->point().x(), vertex->point().y(), false), false});
    }
    for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) face->set_data(view.faces++);
    for (auto edge = arrangement.edges_begin(); edge != arrangement.edges_end(); ++edge) {
      ViewEdge seen;
      const auto vertexOf = [&](const Arrangement::Vertex_handle& vertex) {
        if (!vertex->is_at_open_boundary()) return vertex->data();
        const Kernel::Direction_2 ray = edge->curve().ray().direction();
        view.vertices.push_back({direction(ray.dx(), ray.dy(), true), true});
        return view.vertices.size() - 1;
      };
      seen.source = vertexOf(edge->source());
      seen.target = vertexOf(edge->target());
      seen.curves.assign(edge->curve().data().begin(), edge->curve().data().end());
      seen.right_face = edge->face()->data();
      seen.left_face = edge->twin()->face()->data();
      view.edges.push_back(std::move(seen));
    }
    return view;
  }

  int axis(int step) const { return (dropped_ + step) % 3; }

  Vector normal_;
  int dropped_ = 0;
  int first_ = 1;
  int second_ = 2;
};

}  // namespace irradiff::exact
