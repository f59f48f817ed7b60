#pragma once

// Included by the sources of this folder alone: it includes CGAL.

#include "verification/exact_visibility/exact_scene.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_geodesic_arc_on_sphere_traits_2.h>
#include <CGAL/Arr_spherical_topology_traits_2.h>
#include <CGAL/Arrangement_on_surface_2.h>

#include <array>
#include <cstddef>
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
  ExactLine line;
  Vector start;
  Vector along;
  std::size_t source = 0;  // its ends, of which at most one is on the horizon
  std::size_t target = 0;

  /// Normal of the curve's plane through the receiver, on the right of the line.
  Vector right() const { return cross(start, along); }
  /// t of the point in a direction that the curve is seen in.
  Number parameter(const Vector& direction) const {
    // (start + t along) x direction = 0; all three products are along right(), one component of which decides.
    const Vector side = right();
    const int axis = largestAxis(side);
    return cross(start, direction)[axis] / cross(direction, along)[axis];
  }
};

/// A piece of one or more curves, without another curve across it.
struct ViewEdge {
  std::size_t source = 0;  // vertices of the view
  std::size_t target = 0;
  std::vector<std::size_t> curves;
};

/// All curves as seen from the receiver, cut where they cross. Vertices are known by their direction alone.
struct View {
  std::vector<ViewPoint> vertices;
  std::vector<ViewEdge> edges;
};

/// The arrangement of the curves on the sphere of directions, where they are arcs of great circles.
class DirectionSphere {
 public:
  explicit DirectionSphere(const Vector& normal) : normal_(normal), dropped_(largestAxis(normal)) {}

  View arrange(const std::vector<ViewPoint>& points, const std::vector<ViewCurve>& curves) const {
    const Geodesics geodesics;
    auto point_on_sphere = geodesics.construct_point_2_object();
    auto minor_arc = geodesics.construct_curve_2_object();
    std::vector<Geodesics::Point_2> directions;
    directions.reserve(points.size());
    for (const ViewPoint& point : points) directions.push_back(point_on_sphere(onSphere(point)));
    std::vector<Traits::Curve_2> arcs;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      arcs.emplace_back(minor_arc(directions[curves[i].source], directions[curves[i].target]), i);
    }
    const Traits traits;
    Arrangement arrangement(&traits);
    CGAL::insert(arrangement, arcs.begin(), arcs.end());
    return viewOf(arrangement);
  }

 private:
  using Geodesics = CGAL::Arr_geodesic_arc_on_sphere_traits_2<Kernel>;
  using Traits = CGAL::Arr_consolidated_curve_data_traits_2<Geodesics, std::size_t>;
  using Dcel = CGAL::Arr_extended_dcel<Traits, std::size_t, std::monostate, std::monostate>;
  using Topology = CGAL::Arr_spherical_topology_traits_2<Traits, Dcel>;
  using Arrangement = CGAL::Arrangement_on_surface_2<Traits, Topology>;

  // A linear map keeps great circles. Along n comes first: CGAL's sphere has a seam through its negative first axis,
  // which is then below the horizon and meets it in the poles alone.
  Kernel::Direction_3 onSphere(const ViewPoint& point) const {
    const Vector& w = point.position;
    return {point.on_horizon ? Number(0) : normal_ * w, w[axis(1)], w[axis(2)]};
  }

  // Scaled to n.w = 1, on the horizon to any length.
  ViewPoint fromSphere(const Kernel::Direction_3& direction) const {
    const bool on_horizon = direction.dx() == 0;
    const Number scale = on_horizon ? Number(1) : direction.dx();
    std::array<Number, 3> w;
    w[axis(1)] = direction.dy() / scale;
    w[axis(2)] = direction.dz() / scale;
    const Number rest = normal_[axis(1)] * w[axis(1)] + normal_[axis(2)] * w[axis(2)];
    w[dropped_] = ((on_horizon ? 0 : 1) - rest) / normal_[dropped_];
    return {{w[0], w[1], w[2]}, on_horizon};
  }

  View viewOf(Arrangement& arrangement) const {
    View view;
    for (auto vertex = arrangement.vertices_begin(); vertex != arrangement.vertices_end(); ++vertex) {
      vertex->set_data(view.vertices.size());
      view.vertices.push_back(fromSphere(vertex->point()));
    }
    for (auto edge = arrangement.edges_begin(); edge != arrangement.edges_end(); ++edge) {
      view.edges.push_back({edge->source()->data(), edge->target()->data(), {}});
      view.edges.back().curves.assign(edge->curve().data().begin(), edge->curve().data().end());
    }
    return view;
  }

  int axis(int step) const { return (dropped_ + step) % 3; }

  Vector normal_;
  int dropped_;
};

}  // namespace irradiff::exact
