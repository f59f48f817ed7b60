#include "tests/visibility/rational_view.h"

#include <algorithm>

namespace irradiff {

namespace {

Rational rationalOf(const ExactRational& number) { return Rational(number.numerator) / Rational(number.denominator); }
RationalVector rationalOf(const ExactVector& v) { return {rationalOf(v[0]), rationalOf(v[1]), rationalOf(v[2])}; }

std::size_t indexOf(const FrontPolygon& polygon) { return polygon ? *polygon : kNone; }

struct Plane {
  RationalVector area;
  Rational offset;
};

// Relative to the receiver.
Plane planeOf(const Polygon& polygon, const RationalVector& position) {
  const RationalVector origin = rational(polygon.vertices[0]) - position;
  RationalVector area{};
  for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
    area = area + cross(rational(polygon.vertices[i]) - position - origin,
                        rational(polygon.vertices[i + 1]) - position - origin);
  }
  return {area, dot(area, origin)};
}

// The normal of the line's plane of view.
RationalVector circleOf(const ExactLine& line, std::span<const Polygon> polygons, const RationalVector& position) {
  if (line.kind == ExactLine::Kind::kEdge) {
    const std::vector<Eigen::Vector3d>& vertices = polygons[line.polygon].vertices;
    return withoutScale(cross(rational(vertices[line.edge_or_partner]) - position,
                              rational(vertices[(line.edge_or_partner + 1) % vertices.size()]) - position));
  }
  // That of A a - B b' vanishing at the receiver, for the planes A.p = a and B.p = b.
  const Plane a = planeOf(polygons[line.polygon], position);
  const Plane b = planeOf(polygons[line.edge_or_partner], position);
  return withoutScale(b.offset * a.area - a.offset * b.area);
}

bool isStrictlyInside(const Polygon& polygon, const RationalVector& position, const RationalVector& point) {
  const Plane plane = planeOf(polygon, position);
  if (dot(plane.area, point) != plane.offset) return false;
  bool is_inside = false;
  const std::size_t dropped = plane.area[0] != 0 ? 0 : plane.area[1] != 0 ? 1 : 2;
  const std::size_t u = (dropped + 1) % 3;
  const std::size_t v = (dropped + 2) % 3;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const RationalVector a = rational(polygon.vertices[i]) - position - point;
    const RationalVector b = rational(polygon.vertices[(i + 1) % polygon.vertices.size()]) - position - point;
    const Rational side = a[u] * b[v] - a[v] * b[u];
    if (side == 0 && a[u] * b[u] + a[v] * b[v] <= 0) return false;
    // The edge crosses the ray along u.
    if ((a[v] > 0) != (b[v] > 0) && (side > 0) == (b[v] > a[v])) is_inside = !is_inside;
  }
  return is_inside;
}

// Whether the line, where it is seen in the direction, is inside another polygon.
bool touchesAPolygon(const ExactLine& line, const RationalVector& direction, std::span<const Polygon> polygons,
                     const RationalVector& position) {
  if (line.kind == ExactLine::Kind::kCrease) return false;
  const std::vector<Eigen::Vector3d>& vertices = polygons[line.polygon].vertices;
  const RationalVector start = rational(vertices[line.edge_or_partner]) - position;
  const RationalVector end = rational(vertices[(line.edge_or_partner + 1) % vertices.size()]) - position;
  // (direction s - start) x (end - start) = 0
  const RationalVector side = cross(direction, end - start);
  if (isZero(side)) return false;
  const RationalVector point = dot(cross(start, end - start), side) / dot(side, side) * direction;
  return std::ranges::any_of(polygons, [&](const Polygon& other) { return isStrictlyInside(other, position, point); });
}

// On an edge from t, which has to agree with the point that is given.
RationalVector limitPoint(const ExactArc& arc, const ExactArcLimit& limit, std::span<const Polygon> polygons,
                          std::vector<std::string>& contradictions) {
  RationalVector point = rationalOf(limit.point);
  if (arc.line.kind == ExactLine::Kind::kCrease) return point;
  const std::vector<Eigen::Vector3d>& vertices = polygons[arc.line.polygon].vertices;
  const RationalVector start = rational(vertices[arc.line.edge_or_partner]);
  const RationalVector end = rational(vertices[(arc.line.edge_or_partner + 1) % vertices.size()]);
  const RationalVector on_edge = start + rationalOf(*limit.t) * (end - start);
  if (on_edge != point) contradictions.emplace_back("exactVisibility: point and t of a limit differ");
  return point;
}

}  // namespace

RationalView rationalView(const ExactVisibility& seen, std::span<const Polygon> polygons, const Receiver& receiver) {
  detail::ViewBuilder builder(polygons, receiver);
  RationalView& view = builder.view;
  const RationalVector position = rational(receiver.position);
  for (const ExactArc& arc : seen.arcs) {
    const ArcSidesInView sides = builder.sides(indexOf(arc.left), indexOf(arc.right));
    builder.addArc(limitPoint(arc, arc.begin, polygons, view.contradictions) - position,
                   limitPoint(arc, arc.end, polygons, view.contradictions) - position, sides);
    if (!arc.aligned.empty() && sides.left != sides.right) {
      view.lines_over_each_other.insert(circleOf(arc.line, polygons, position));
      const RationalVector within = rationalOf(arc.begin.point) - position + rationalOf(arc.end.point) - position;
      view.has_aligned_arcs = view.has_aligned_arcs || std::ranges::any_of(arc.aligned, [&](const ExactLine& line) {
                                return !touchesAPolygon(line, within, polygons, position);
                              });
    }
  }
  for (const std::size_t polygon : seen.edge_on) {
    view.edge_on.insert(polygon);
    const RationalVector circle = withoutScale(planeOf(polygons[polygon], position).area);
    view.edge_on_circles.insert(circle);
    view.lines_over_each_other.insert(circle);
  }
  for (const ExactHorizonArc& arc : seen.horizon) {
    builder.addHorizon(rationalOf(arc.begin), rationalOf(arc.end), arc.polygon);
  }
  builder.join();

  const auto radiance = [&](std::size_t polygon) { return polygon == kNone ? 0.0 : polygons[polygon].radiance; };
  for (const ExactApparentVertex& vertex : seen.apparent_vertices) {
    const RationalVector direction = rationalOf(vertex.direction);
    // What is seen beside a line before the vertex and after it.
    const auto besides = [&](const RationalVector& circle) {
      const CirclePlace place = builder.place(circle, direction);
      std::pair<ArcSidesInView, ArcSidesInView> sides;
      for (const ArcInView& arc : view.arcs[circle]) {
        if (arc.from < place && place <= arc.to) sides.first = arc.sides;
        if (arc.from <= place && place < arc.to) sides.second = arc.sides;
      }
      return sides;
    };
    if (vertex.degenerate) {
      bool changes_radiance = false;
      bool touches = false;
      for (const ExactLine& line : vertex.lines) {
        touches = touches || touchesAPolygon(line, direction, polygons, position);
        const auto [before, after] = besides(circleOf(line, polygons, position));
        for (const ArcSidesInView& sides : {before, after}) {
          changes_radiance = changes_radiance || radiance(sides.left) != radiance(sides.right);
        }
      }
      view.meetings[direction] = changes_radiance && !touches;
      continue;
    }
    const RationalVector far_circle = circleOf(vertex.lines[1], polygons, position);
    const auto [before, after] = besides(far_circle);
    if (before == after) continue;
    view.vertices.insert({direction, far_circle, circleOf(vertex.lines[0], polygons, position), before, after});
  }
  return view;
}

}  // namespace irradiff
