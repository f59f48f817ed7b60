#include "verification/exact_visibility/exact_visibility.h"

#include "verification/exact_visibility/exact_scene.h"
#include "verification/exact_visibility/view_arrangement.h"

#include <CGAL/Fraction_traits.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <utility>

namespace irradiff {

namespace {

using exact::ExactScene;
using exact::isZero;
using exact::Number;
using exact::Vector;
using exact::View;
using exact::ViewCurve;
using exact::ViewEdge;
using exact::ViewedPolygon;
using exact::ViewPoint;

ExactRational rational(const Number& number) {
  const auto& value = CGAL::exact(number);
  using Fraction = CGAL::Fraction_traits<std::remove_cvref_t<decltype(value)>>;
  typename Fraction::Numerator_type numerator;
  typename Fraction::Denominator_type denominator;
  typename Fraction::Decompose()(value, numerator, denominator);
  std::ostringstream above;
  std::ostringstream below;
  above << numerator;
  below << denominator;
  return {above.str(), below.str(), CGAL::to_double(value)};
}

ExactVector rational(const Vector& v) { return {rational(v.x()), rational(v.y()), rational(v.z())}; }

// The lines of the scene as far as they are above the horizon.
class VisibleLines {
 public:
  explicit VisibleLines(const ExactScene& scene) : normal_(scene.normal()) {
    const std::vector<ViewedPolygon>& polygons = scene.polygons();
    for (const ViewedPolygon& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.vertices().size(); ++i) {
        add({ExactLine::Kind::kEdge, polygon.index(), i}, polygon.vertices()[i], polygon.vertexAfter(i));
      }
    }
    for (std::size_t a = 0; a < polygons.size(); ++a) {
      for (std::size_t b = a + 1; b < polygons.size(); ++b) {
        for (const auto& [start, end] : exact::creases(polygons[a], polygons[b])) {
          add({ExactLine::Kind::kCrease, polygons[a].index(), polygons[b].index()}, start, end);
        }
      }
    }
  }

  const std::vector<ViewPoint>& points() const { return points_; }
  const std::vector<ViewCurve>& curves() const { return curves_; }
  /// Directions in which a line reaches the horizon, from above or along it.
  const std::vector<Vector>& horizonDirections() const { return horizon_directions_; }

 private:
  void add(const ExactLine& line, const Vector& start, const Vector& end) {
    const Number from = normal_ * start;
    const Number to = normal_ * end;
    if (from <= 0 && to <= 0) {
      if (from == 0) horizon_directions_.push_back(start);
      if (to == 0) horizon_directions_.push_back(end);
      return;
    }
    ViewCurve curve{line, start, end - start};
    const auto end_point = [&](const Vector& point, const Number& height) {
      if (height > 0) return pointAt(point, false);
      horizon_directions_.push_back(start + curve.along * (from / (from - to)));
      return pointAt(horizon_directions_.back(), true);
    };
    curve.source = end_point(start, from);
    curve.target = end_point(end, to);
    curves_.push_back(std::move(curve));
  }

  // Points that are one in space are to be one number as well: comparing equal ones is what costs exact arithmetic.
  std::size_t pointAt(const Vector& position, bool on_horizon) {
    const auto [place, is_new] = known_points_.try_emplace({position.x(), position.y(), position.z()}, points_.size());
    if (is_new) points_.push_back({position, on_horizon});
    return place->second;
  }

  Vector normal_;
  std::vector<ViewPoint> points_;
  std::map<std::array<Number, 3>, std::size_t> known_points_;
  std::vector<ViewCurve> curves_;
  std::vector<Vector> horizon_directions_;
};

// A curve at a vertex or an edge of the view.
struct CurveInDirection {
  std::size_t curve;
  Number inverse_depth;
};

// What is front-most beside every edge of the view, and what of it changes where.
class Boundary {
 public:
  Boundary(const ExactScene& scene, const VisibleLines& lines)
      : scene_(scene),
        curves_(lines.curves()),
        view_(exact::DirectionSphere(scene.normal()).arrange(lines.points(), curves_)) {
    for (const ViewEdge& edge : view_.edges) sides_.push_back(sidesOf(edge));
    vertex_edges_.resize(view_.vertices.size());
    for (std::size_t i = 0; i < view_.edges.size(); ++i) {
      vertex_edges_[view_.edges[i].source].push_back(i);
      vertex_edges_[view_.edges[i].target].push_back(i);
    }
    for (std::size_t v = 0; v < view_.vertices.size(); ++v) {
      exposed_.push_back(view_.vertices[v].on_horizon ? std::vector<CurveInDirection>{} : exposedAt(v));
    }
  }

  std::vector<ExactArc> arcs() const {
    std::vector<Piece> pieces;
    for (std::size_t e = 0; e < view_.edges.size(); ++e) {
      if (sides_[e].left != sides_[e].right) pieces.push_back(pieceOf(view_.edges[e], sides_[e]));
    }
    std::ranges::sort(pieces, [this](const Piece& a, const Piece& b) {
      const ExactLine& line_of_a = curves_[a.curve].line;
      const ExactLine& line_of_b = curves_[b.curve].line;
      if (!(line_of_a == line_of_b)) return line_of_a < line_of_b;
      return a.curve != b.curve ? a.curve < b.curve : a.begin < b.begin;
    });
    std::vector<ExactArc> arcs;
    for (std::size_t first = 0; first < pieces.size();) {
      std::size_t last = first;
      while (last + 1 < pieces.size() && continues(pieces[last], pieces[last + 1])) ++last;
      const Piece& piece = pieces[first];
      ExactArc arc{curves_[piece.curve].line,
                   limitAt(piece.curve, piece.begin, piece.begin_vertex),
                   limitAt(piece.curve, pieces[last].end, pieces[last].end_vertex),
                   piece.sides.left,
                   piece.sides.right,
                   {}};
      for (std::size_t i = first; i <= last; ++i) {
        arc.aligned.insert(arc.aligned.end(), pieces[i].aligned.begin(), pieces[i].aligned.end());
      }
      std::sort(arc.aligned.begin(), arc.aligned.end());
      arc.aligned.erase(std::unique(arc.aligned.begin(), arc.aligned.end()), arc.aligned.end());
      arcs.push_back(std::move(arc));
      first = last + 1;
    }
    return arcs;
  }

  std::vector<ExactApparentVertex> apparentVertices() const {
    std::vector<ExactApparentVertex> vertices;
    for (std::size_t v = 0; v < view_.vertices.size(); ++v) {
      const std::vector<CurveInDirection>& exposed = exposed_[v];
      bool cross_apart = false;
      for (std::size_t i = 0; i < exposed.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          cross_apart = cross_apart ||
                        (exposed[i].inverse_depth != exposed[j].inverse_depth &&
                         !isZero(exact::cross(curves_[exposed[i].curve].right(), curves_[exposed[j].curve].right())));
        }
      }
      if (!cross_apart) continue;
      ExactApparentVertex vertex{rational(view_.vertices[v].position), {}, exposed.size() > 2};
      for (const CurveInDirection& c : exposed) vertex.lines.push_back(curves_[c.curve].line);
      vertices.push_back(std::move(vertex));
    }
    std::ranges::sort(vertices, [](const auto& a, const auto& b) { return a.lines < b.lines; });
    return vertices;
  }

 private:
  // What is front-most beside an edge of the view, from its source to its target.
  struct Sides {
    FrontPolygon left;
    FrontPolygon right;
    bool operator==(const Sides&) const = default;
  };

  // An edge of the view between two different front-most polygons, along its curve.
  struct Piece {
    std::size_t curve;
    Number begin;
    Number end;
    std::size_t begin_vertex;
    std::size_t end_vertex;
    Sides sides;
    std::vector<ExactLine> aligned;
  };

  static bool continues(const Piece& a, const Piece& b) {
    return a.curve == b.curve && a.end == b.begin && a.sides == b.sides;
  }

  Vector middleOf(const ViewEdge& edge) const {
    return view_.vertices[edge.source].position + view_.vertices[edge.target].position;
  }
  Sides sidesOf(const ViewEdge& edge) const {
    const Vector right = exact::cross(view_.vertices[edge.source].position, view_.vertices[edge.target].position);
    return {scene_.frontMost(middleOf(edge), -right), scene_.frontMost(middleOf(edge), right)};
  }

  Number inverseDepth(FrontPolygon polygon, const Vector& direction) const {
    return polygon ? scene_.polygon(*polygon).inverseDepth() * direction : Number(0);
  }

  Number inverseDepth(const ViewCurve& curve, const Vector& direction) const {
    const Vector point = curve.start + curve.along * curve.parameter(direction);
    return (scene_.normal() * direction) / (scene_.normal() * point);
  }

  // Of the curves, all seen in that direction, those that are not farther than `farthest` and separate something, the
  // nearest first; one for each straight line, the lowest.
  std::vector<CurveInDirection> exposedIn(const Vector& direction, std::vector<std::size_t> curves,
                                          const Number& farthest) const {
    std::ranges::sort(curves, [this](std::size_t a, std::size_t b) { return curves_[a].line < curves_[b].line; });
    std::vector<CurveInDirection> exposed;
    for (const std::size_t c : curves) {
      const ViewCurve& curve = curves_[c];
      const Number inverse_depth = inverseDepth(curve, direction);
      if (inverse_depth < farthest) continue;
      if (curve.line.kind == ExactLine::Kind::kEdge && scene_.isCoveredInItsPlane(curve.line.polygon, direction)) {
        continue;
      }
      const auto on_same_line = [&](const CurveInDirection& other) { return onOneLine(curve, curves_[other.curve]); };
      if (std::ranges::none_of(exposed, on_same_line)) exposed.push_back({c, inverse_depth});
    }
    std::ranges::stable_sort(exposed, [](const auto& a, const auto& b) { return a.inverse_depth > b.inverse_depth; });
    return exposed;
  }

  static bool onOneLine(const ViewCurve& a, const ViewCurve& b) {
    return isZero(exact::cross(a.along, b.along)) && isZero(exact::cross(b.start - a.start, a.along));
  }

  // Nothing is hidden that is as near as the front-most polygon on one side around.
  std::vector<CurveInDirection> exposedAt(std::size_t vertex) const {
    const Vector& direction = view_.vertices[vertex].position;
    std::vector<std::size_t> curves;
    std::optional<Number> farthest;
    for (const std::size_t e : vertex_edges_[vertex]) {
      const ViewEdge& edge = view_.edges[e];
      curves.insert(curves.end(), edge.curves.begin(), edge.curves.end());
      for (const FrontPolygon& front : {sides_[e].left, sides_[e].right}) {
        const Number inverse_depth = inverseDepth(front, direction);
        if (!farthest || inverse_depth < *farthest) farthest = inverse_depth;
      }
    }
    std::ranges::sort(curves);
    curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
    return exposedIn(direction, std::move(curves), *farthest);
  }

  Piece pieceOf(const ViewEdge& edge, const Sides& sides) const {
    const Vector middle = middleOf(edge);
    const Number farther = std::min(inverseDepth(sides.left, middle), inverseDepth(sides.right, middle));
    const std::vector<CurveInDirection> exposed = exposedIn(middle, edge.curves, farther);
    // The nearer side ends here, or both meet here: in either case the nearest exposed line is where.
    const std::size_t own = exposed.front().curve;
    const ViewCurve& curve = curves_[own];
    Piece piece{own,
                curve.parameter(view_.vertices[edge.source].position),
                curve.parameter(view_.vertices[edge.target].position),
                edge.source,
                edge.target,
                sides,
                {}};
    if (piece.begin > piece.end) {
      std::swap(piece.begin, piece.end);
      std::swap(piece.begin_vertex, piece.end_vertex);
      std::swap(piece.sides.left, piece.sides.right);
    }
    for (std::size_t i = 1; i < exposed.size(); ++i) piece.aligned.push_back(curves_[exposed[i].curve].line);
    return piece;
  }

  ExactArcLimit limitAt(std::size_t own, const Number& t, std::size_t vertex) const {
    const ViewCurve& curve = curves_[own];
    ExactArcLimit limit;
    if (view_.vertices[vertex].on_horizon) {
      limit.kind = ExactLimitKind::kHorizon;
    } else if (!CGAL::is_zero(t) && !CGAL::is_one(t)) {
      limit.kind = ExactLimitKind::kCrossing;
    }
    if (curve.line.kind == ExactLine::Kind::kEdge) limit.t = rational(t);
    limit.point = rational(Vector(scene_.position() + curve.start + curve.along * t));
    const Number inverse_depth =
        limit.kind == ExactLimitKind::kHorizon ? Number(0) : inverseDepth(curve, view_.vertices[vertex].position);
    for (const CurveInDirection& other : exposed_[vertex]) {
      const bool is_own = onOneLine(curve, curves_[other.curve]);
      const bool is_of_same_corner = limit.kind == ExactLimitKind::kEndpoint && other.inverse_depth == inverse_depth;
      if (!is_own && !is_of_same_corner) limit.crossing.push_back(curves_[other.curve].line);
    }
    return limit;
  }

  const ExactScene& scene_;
  const std::vector<ViewCurve>& curves_;
  View view_;
  std::vector<Sides> sides_;  // by edge
  std::vector<std::vector<std::size_t>> vertex_edges_;
  std::vector<std::vector<CurveInDirection>> exposed_;  // by vertex
};

// Azimuths around n, from some direction on: true if a comes before b.
class AzimuthOrder {
 public:
  AzimuthOrder(const Vector& normal, const Vector& zero) : normal_(normal), zero_(zero) {}
  bool operator()(const Vector& a, const Vector& b) const {
    const int half_of_a = half(a);
    const int half_of_b = half(b);
    return half_of_a != half_of_b ? half_of_a < half_of_b : turn(a, b) > 0;
  }

  /// Positive where b is less than half a turn counterclockwise of a.
  CGAL::Sign turn(const Vector& a, const Vector& b) const { return CGAL::sign(normal_ * exact::cross(a, b)); }

 private:
  int half(const Vector& a) const {
    const CGAL::Sign side = turn(zero_, a);
    if (side == CGAL::ZERO) return zero_ * a > 0 ? 0 : 2;
    return side == CGAL::POSITIVE ? 1 : 3;
  }

  Vector normal_;
  Vector zero_;
};

std::vector<ExactHorizonArc> horizonArcs(const ExactScene& scene, std::vector<Vector> directions) {
  if (directions.empty()) return {};
  const AzimuthOrder before(scene.normal(), directions[0]);
  std::ranges::sort(directions, before);
  const auto are_equal = [&before](const Vector& a, const Vector& b) { return !before(a, b) && !before(b, a); };
  directions.erase(std::unique(directions.begin(), directions.end(), are_equal), directions.end());

  struct Interval {
    std::size_t begin;
    std::size_t end;
    std::size_t polygon;
  };
  std::vector<Interval> intervals;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::size_t next = (i + 1) % directions.size();
    // A polygon that is not edge-on takes less than half a turn, and begins and ends in one of the directions.
    if (before.turn(directions[i], directions[next]) != CGAL::POSITIVE) continue;
    const FrontPolygon front = scene.frontMost(directions[i] + directions[next], scene.normal());
    if (!front) continue;
    if (!intervals.empty() && intervals.back().end == i && intervals.back().polygon == *front) {
      intervals.back().end = next;
    } else {
      intervals.push_back({i, next, *front});
    }
  }
  // The first direction is in the middle of an arc as likely as not.
  if (intervals.size() > 1 && intervals.front().begin == 0 && intervals.back().end == 0 &&
      intervals.front().polygon == intervals.back().polygon) {
    intervals.front().begin = intervals.back().begin;
    intervals.pop_back();
  }
  std::vector<ExactHorizonArc> arcs;
  arcs.reserve(intervals.size());
  for (const Interval& interval : intervals) {
    arcs.push_back({rational(directions[interval.begin]), rational(directions[interval.end]), interval.polygon});
  }
  return arcs;
}

}  // namespace

ExactVisibility exactVisibility(const std::vector<Polygon>& polygons, const Receiver& receiver) {
  const ExactScene scene(polygons, receiver);
  const VisibleLines lines(scene);
  const Boundary boundary(scene, lines);
  return {boundary.arcs(), boundary.apparentVertices(), horizonArcs(scene, lines.horizonDirections()), scene.edgeOn()};
}

}  // namespace irradiff
