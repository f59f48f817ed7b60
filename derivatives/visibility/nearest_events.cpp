#include "derivatives/visibility/nearest_events.h"

#include "derivatives/visibility/boundary_of_view.h"
#include "derivatives/visibility/scene_evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace irradiff {
namespace {

using WideVector = Vector3<DoubleWord<double>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnitRoundoff = 0x1p-53;

double determinant(const WideVector& a, const WideVector& b, const WideVector& c) {
  return static_cast<double>(dot(cross(a, b), c));
}

/// A place that the receiver, at the origin, may move to.
struct Reach {
  Vector3<double> place = Vector3<double>::Constant(kInfinity);
  double distance = kInfinity;
  double lever = 0.0;  ///< of the receiver beyond the nearer point, over the distance of both points

  void take(const Vector3<double>& other, double other_distance, double other_lever) {
    if (other_distance < distance) *this = {other, other_distance, other_lever};
  }
};

/// What is known of a point of the mesh.
struct ViewedPoint {
  WideVector wide;  ///< relative to the receiver
  Vector3<double> position;
  double height = 0.0;
  bool may_appear = false;
  bool is_seen = false;  ///< an arc ends there, or might once it is above the horizon
};

struct ViewedEdge {
  bool may_appear = false;  ///< now or when the receiver has moved
  bool is_seen = false;     ///< an arc lies on it, or might
};

/// From where a point is seen on a straight edge from `a` to `b`, both as seen from it: `front` where the point is the
/// nearer, `back` where the edge is. Half planes cut off: the nearest place is the foot in their plane, or on their
/// outline. `offset` is the determinant of all three.
Reach reachOfVertexOnEdge(const Vector3<double>& point, const Vector3<double>& a, const Vector3<double>& b,
                          double offset, bool front, bool back) {
  const Vector3<double> normal = a.cross(b);
  const double square = normal.squaredNorm();
  const Vector3<double> receiver = -point;  // as seen from the point
  const double along_a = receiver.cross(b).dot(normal) / square;
  const double along_b = a.cross(receiver).dot(normal) / square;
  const Vector3<double> foot = (offset / square) * normal;
  const double plane_distance = std::abs(offset) / std::sqrt(square);
  Reach reach;
  const auto takeRay = [&](const Vector3<double>& from, const Vector3<double>& along, double pace) {
    // Places from + t along; the lever grows as `pace` times t.
    const double t = std::max(0.0, (receiver - from).dot(along) / along.squaredNorm());
    const Vector3<double> place = point + from + t * along;
    reach.take(place, place.norm(), pace * t);
  };
  if (front) {
    if (along_a <= 0.0 && along_b <= 0.0) {
      reach.take(foot, plane_distance, -(along_a + along_b));
    } else {
      takeRay(Vector3<double>::Zero(), -a, 1.0);
      takeRay(Vector3<double>::Zero(), -b, 1.0);
    }
  }
  if (back) {
    if (along_a >= 0.0 && along_b >= 0.0 && along_a + along_b >= 1.0) {
      reach.take(foot, plane_distance, along_a + along_b - 1.0);
    } else {
      takeRay(a, a, 1.0);
      takeRay(b, b, 1.0);
      const Vector3<double> edge = b - a;
      const double t = std::clamp((receiver - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      const Vector3<double> place = point + a + t * edge;
      reach.take(place, place.norm(), 0.0);
    }
  }
  return reach;
}

/// An event before it has a text: edges, points or faces that meet.
struct Candidate {
  double distance;
  double rounding;
  Vector3<double> displacement;
  std::array<std::size_t, 3> ids;
};

struct PlaneOfView;

/// Everything in units of the mesh and relative to the receiver.
class EventSearch {
 public:
  EventSearch(const SceneMesh& mesh, std::span<const Polygon> polygons, const std::vector<bool>& is_present,
              const std::vector<bool>& is_own_surface, const VisibleBoundary& view, const Receiver& receiver);

  Nearest<Candidate> verticesOnEdges(std::size_t count) const;
  Nearest<Candidate> threeEdges(std::size_t count) const;
  Nearest<Candidate> edgeOn(std::size_t count) const;
  Nearest<Candidate> onHorizon(std::size_t count) const;
  Nearest<Candidate> crossingsOnHorizon(std::size_t count) const;
  /// Whether a point ends an edge along the horizon: with it a whole edge comes to lie there.
  bool endsEdgeAlongHorizon(std::size_t point) const;

  std::string describePoint(std::size_t point) const;
  std::string describeEdge(std::size_t edge) const;
  std::string describeFace(std::size_t face) const;

 private:
  bool isPresentFace(std::size_t face) const { return is_present_[mesh_.faces()[face].polygon]; }
  bool mayMeet(std::size_t point, std::size_t edge) const;
  bool areJoined(std::size_t a, std::size_t b) const;
  Reach reachOf(std::size_t point, std::size_t edge, bool front, bool back, double limit) const;
  double distanceToCrossing(std::size_t a, std::size_t b) const;
  PlaneOfView planeOf(std::size_t edge) const;

  const SceneMesh& mesh_;
  std::span<const Polygon> polygons_;
  const std::vector<bool>& is_present_;
  const std::vector<bool>& is_own_surface_;
  const VisibleBoundary& view_;
  Vector3<double> normal_;
  double rounding_;  ///< by how far a point may be off for the rounding of its coordinates
  std::vector<ViewedPoint> points_;
  std::vector<ViewedEdge> edges_;
};

EventSearch::EventSearch(const SceneMesh& mesh, std::span<const Polygon> polygons, const std::vector<bool>& is_present,
                         const std::vector<bool>& is_own_surface, const VisibleBoundary& view, const Receiver& receiver)
    : mesh_(mesh),
      polygons_(polygons),
      is_present_(is_present),
      is_own_surface_(is_own_surface),
      view_(view),
      normal_(receiver.normal),
      points_(mesh.points().size()),
      edges_(mesh.edges().size()) {
  const Vector3<double> position =
      receiver.position.unaryExpr([&](double c) { return std::ldexp(c, -mesh.exponent()); });
  const detail::ViewGeometry<double, DoubleWord<double>> geometry(mesh, 0, position, normal_);
  double largest = position.cwiseAbs().maxCoeff();
  for (const Eigen::Vector3d& vertex : mesh.vertices()) largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  rounding_ = std::sqrt(3.0) * kUnitRoundoff * largest;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const MeshEdge& edge = mesh.edges()[e];
    const auto mayAppear = [&](std::size_t face) { return !is_own_surface_[mesh.faces()[face].polygon]; };
    edges_[e].may_appear =
        edge.is_crease ? std::ranges::all_of(edge.faces, mayAppear) : std::ranges::any_of(edge.faces, mayAppear);
    for (const auto& [point, kind] :
         {std::pair{edge.start, EdgePlace::Kind::kStart}, std::pair{edge.end, EdgePlace::Kind::kEnd}}) {
      const auto place = geometry.place(e, {kind});
      ViewedPoint& viewed = points_[point];
      viewed.wide = place.position;
      viewed.position = narrow<double>(place.position);
      viewed.height = static_cast<double>(place.height);
      viewed.may_appear = viewed.may_appear || edges_[e].may_appear;
    }
  }
  for (const VisibleArc& arc : view.arcs) {
    edges_[arc.edge].is_seen = true;
    for (const EdgePlace& place : {arc.first, arc.last}) {
      if (place.kind == EdgePlace::Kind::kStart) points_[mesh.edges()[arc.edge].start].is_seen = true;
      if (place.kind == EdgePlace::Kind::kEnd) points_[mesh.edges()[arc.edge].end].is_seen = true;
      if (place.kind == EdgePlace::Kind::kPoint) points_[place.id].is_seen = true;
    }
  }
  // What is not above the horizon may be seen once it rises.
  for (ViewedPoint& point : points_) point.is_seen = point.is_seen || point.height <= 0.0;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const MeshEdge& edge = mesh.edges()[e];
    if (std::min(points_[edge.start].height, points_[edge.end].height) <= 0.0) edges_[e].is_seen = true;
  }
}

/// Whether there is a plane of places from which they meet: not for a point of the edge, and not in a face's own plane,
/// where the face is seen edge-on.
bool EventSearch::mayMeet(std::size_t point, std::size_t edge) const {
  return !mesh_.isKnownOnLine(point, edge) && std::ranges::none_of(mesh_.edges()[edge].faces, [&](std::size_t face) {
    return mesh_.isKnownInPlane(point, face);
  });
}

/// Whether two edges bound one face, or meet in a point of the mesh: with a third edge they meet in view where that
/// point does, or where the face is seen edge-on. Creases may cross within a face, where there is no point of the mesh.
bool EventSearch::areJoined(std::size_t a, std::size_t b) const {
  const MeshEdge& first = mesh_.edges()[a];
  const MeshEdge& second = mesh_.edges()[b];
  if (mesh_.isKnownOnLine(first.start, b) || mesh_.isKnownOnLine(first.end, b) ||
      mesh_.isKnownOnLine(second.start, a) || mesh_.isKnownOnLine(second.end, a)) {
    return true;
  }
  if (first.is_crease && second.is_crease) return false;
  return std::ranges::any_of(
      first.faces, [&](std::size_t face) { return std::ranges::find(second.faces, face) != second.faces.end(); });
}

/// Infinitely far where it is `limit` or more.
Reach EventSearch::reachOf(std::size_t point, std::size_t edge, bool front, bool back, double limit) const {
  const MeshEdge& e = mesh_.edges()[edge];
  const ViewedPoint& p = points_[point];
  const Vector3<double> a = points_[e.start].position - p.position;
  const Vector3<double> b = points_[e.end].position - p.position;
  const Vector3<double> normal = a.cross(b);
  const double size = normal.norm();
  // Plain first: what is far away needs no doubled precision.
  const double uncertainty = 16.0 * kUnitRoundoff * a.norm() * b.norm() * p.position.norm();
  if (std::abs(normal.dot(p.position)) - uncertainty >= limit * size || !mayMeet(point, edge)) return {};
  const double offset =
      determinant(difference(points_[e.start].wide, p.wide), difference(points_[e.end].wide, p.wide), p.wide);
  if (!(size > 0.0)) return {};
  return reachOfVertexOnEdge(p.position, a, b, offset, front, back);
}

Nearest<Candidate> EventSearch::verticesOnEdges(std::size_t count) const {
  Nearest<Candidate> nearest(count);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (!edges_[e].may_appear) continue;
    const double highest = std::max(points_[mesh_.edges()[e].start].height, points_[mesh_.edges()[e].end].height);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (!points_[p].may_appear || !(points_[p].is_seen || edges_[e].is_seen)) continue;
      // Nothing meets below the horizon.
      if (std::min(highest, points_[p].height) <= -nearest.limit()) continue;
      // What is hidden comes out behind what is seen, and never in front of it.
      const Reach reach = reachOf(p, e, points_[p].is_seen, edges_[e].is_seen, nearest.limit());
      if (reach.distance < nearest.limit()) {
        nearest.add({reach.distance, 2.0 * (1.0 + reach.lever) * rounding_, reach.place, {p, e, kNone}});
      }
    }
  }
  return nearest;
}

/// 0 if the edges cross in view, else the distance of what has to happen before they do.
double EventSearch::distanceToCrossing(std::size_t a, std::size_t b) const {
  const auto ends = [&](std::size_t e) { return std::array{mesh_.edges()[e].start, mesh_.edges()[e].end}; };
  const auto isBetween = [&](std::size_t edge, std::size_t other) {
    const auto [start, end] = ends(edge);
    const auto [other_start, other_end] = ends(other);
    const Vector3<double> plane = points_[start].position.cross(points_[end].position);
    return plane.dot(points_[other_start].position) * plane.dot(points_[other_end].position) < 0.0;
  };
  if (isBetween(a, b) && isBetween(b, a)) return 0.0;
  double distance = kInfinity;
  for (const auto& [edge, other] : {std::pair{a, b}, std::pair{b, a}}) {
    for (const std::size_t point : ends(other)) {
      distance = std::min(distance, reachOf(point, edge, true, true, kInfinity).distance);
    }
  }
  return distance;
}

// Edges r_i, e_i meet in one direction where the normals m_i = r_i x e_i of their planes of view lie in one plane. With
// the receiver moved by h, det(m_i - h x e_i) = det(m_i) - h.g + q(h) with
//   g = e_1 x (m_2 x m_3) + ...,  q(h) = (h.m_3)(h.(e_1 x e_2)) + ...:
// there is no cubic term, since all three h x e_i are across h. The horizon is an edge with m = n, e = 0.
struct PlaneOfView {
  WideVector wide;
  Vector3<double> normal;
  Vector3<double> edge;
};

/// The distance at which three edges meet in view, were they as long as may be; nothing where it is `limit` or more.
std::optional<Candidate> meeting(const PlaneOfView& a, const PlaneOfView& b, const PlaneOfView& c, double limit) {
  const std::array<Vector3<double>, 3> slopes = {a.edge.cross(b.normal.cross(c.normal)),
                                                 b.edge.cross(c.normal.cross(a.normal)),
                                                 c.edge.cross(a.normal.cross(b.normal))};
  const Vector3<double> slope = slopes[0] + slopes[1] + slopes[2];
  const double slope_size = slope.norm();
  const double a_size = a.normal.norm();
  const double b_size = b.normal.norm();
  const double c_size = c.normal.norm();
  const double curvature = a_size * b.edge.cross(c.edge).norm() + b_size * c.edge.cross(a.edge).norm() +
                           c_size * a.edge.cross(b.edge).norm();
  // Nearer |det| - |g||h| - |q| |h|^2 is positive.
  const auto reachedFrom = [&](double value) {
    return value > 0.0 ? 2.0 * value / (slope_size + std::sqrt(slope_size * slope_size + 4.0 * curvature * value))
                       : 0.0;
  };
  const double uncertainty = 16.0 * kUnitRoundoff * a_size * b_size * c_size;
  if (reachedFrom(std::abs(a.normal.cross(b.normal).dot(c.normal)) - uncertainty) >= limit) return std::nullopt;
  if (!(slope_size > 0.0)) return std::nullopt;
  const double value = determinant(a.wide, b.wide, c.wide);
  const double distance = reachedFrom(std::abs(value));
  if (!(distance < limit)) return std::nullopt;
  // The lever: how far the surface of the event moves if each edge does by 1.
  const double lever = (slopes[0].norm() + slopes[1].norm() + slopes[2].norm()) / slope_size;
  return Candidate{distance, lever, (value / (slope_size * slope_size)) * slope, {kNone, kNone, kNone}};
}

PlaneOfView EventSearch::planeOf(std::size_t e) const {
  const MeshEdge& edge = mesh_.edges()[e];
  const WideVector& start = points_[edge.start].wide;
  const WideVector along = difference(points_[edge.end].wide, start);
  const WideVector normal = cross(start, along);
  return {normal, narrow<double>(normal), narrow<double>(along)};
}

Nearest<Candidate> EventSearch::threeEdges(std::size_t count) const {
  std::vector<PlaneOfView> planes;
  for (std::size_t e = 0; e < edges_.size(); ++e) planes.push_back(planeOf(e));
  Nearest<Candidate> nearest(count);
  for (const ApparentVertex& vertex : view_.apparent_vertices) {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!edges_[e].may_appear || e == vertex.farther || e == vertex.nearer) continue;
      std::optional<Candidate> candidate =
          meeting(planes[vertex.farther], planes[vertex.nearer], planes[e], nearest.limit());
      if (!candidate || areJoined(vertex.nearer, e) || areJoined(vertex.farther, e)) continue;
      // Three edges that meet cross each other: those that do not must first come to.
      candidate->distance =
          std::max({candidate->distance, distanceToCrossing(vertex.farther, e), distanceToCrossing(vertex.nearer, e)});
      candidate->rounding = (1.0 + candidate->rounding) * rounding_;
      candidate->ids = {vertex.nearer, vertex.farther, e};
      nearest.add(*candidate);
    }
  }
  return nearest;
}

/// Where edges cross on the horizon: those that do above it, and those that are seen down to it with all others.
Nearest<Candidate> EventSearch::crossingsOnHorizon(std::size_t count) const {
  const PlaneOfView horizon{widen<DoubleWord<double>>(normal_), normal_, Vector3<double>::Zero()};
  Nearest<Candidate> nearest(count);
  const auto take = [&](std::size_t a, std::size_t b) {
    std::optional<Candidate> candidate = meeting(planeOf(a), planeOf(b), horizon, nearest.limit());
    if (!candidate || areJoined(a, b)) return;
    candidate->distance = std::max(candidate->distance, distanceToCrossing(a, b));
    candidate->rounding = (1.0 + candidate->rounding) * rounding_;
    candidate->ids = {a, b, kNone};
    nearest.add(*candidate);
  };
  std::vector<bool> reaches_horizon(edges_.size(), false);
  for (const VisibleArc& arc : view_.arcs) {
    const bool is_cut = arc.first.kind == EdgePlace::Kind::kHorizon || arc.last.kind == EdgePlace::Kind::kHorizon;
    if (is_cut) reaches_horizon[arc.edge] = true;
  }
  for (std::size_t a = 0; a < edges_.size(); ++a) {
    if (!reaches_horizon[a]) continue;
    for (std::size_t b = 0; b < edges_.size(); ++b) {
      const auto isNearHorizon = [&](std::size_t point) { return std::abs(points_[point].height) < nearest.limit(); };
      const MeshEdge& edge = mesh_.edges()[b];
      const bool is_cut = points_[edge.start].height * points_[edge.end].height < 0.0;
      if (b == a || !edges_[b].may_appear || !(is_cut || isNearHorizon(edge.start) || isNearHorizon(edge.end)))
        continue;
      take(a, b);
    }
  }
  for (const ApparentVertex& vertex : view_.apparent_vertices) {
    if (!reaches_horizon[vertex.nearer] && !reaches_horizon[vertex.farther]) take(vertex.nearer, vertex.farther);
  }
  return nearest;
}

Nearest<Candidate> EventSearch::edgeOn(std::size_t count) const {
  std::vector<bool> is_concerned(polygons_.size(), false);
  for (const VisibleArc& arc : view_.arcs) {
    for (const std::size_t face : mesh_.edges()[arc.edge].faces) is_concerned[mesh_.faces()[face].polygon] = true;
    for (const std::size_t polygon : {arc.sides.left, arc.sides.right}) {
      if (polygon != kNone) is_concerned[polygon] = true;
    }
  }
  Nearest<Candidate> nearest(count);
  for (std::size_t f = 0; f < mesh_.faces().size(); ++f) {
    const MeshFace& face = mesh_.faces()[f];
    if (!isPresentFace(f)) continue;
    const bool rises =
        std::ranges::any_of(face.vertices, [&](std::size_t v) { return points_[v].height > -nearest.limit(); });
    if (!rises) continue;
    const ViewedPoint& p = points_[face.plane[0]];
    const WideVector a = difference(points_[face.plane[1]].wide, p.wide);
    const WideVector b = difference(points_[face.plane[2]].wide, p.wide);
    const Vector3<double> normal = narrow<double>(cross(a, b));
    const double square = normal.squaredNorm();
    if (!(square > 0.0)) continue;
    const double offset = determinant(a, b, p.wide);
    // Exactly edge-on it has no sides to be seen.
    if (!is_concerned[face.polygon] && !(offset == 0.0 && view_.edges_in_line)) continue;
    const double along_a = -p.position.cross(narrow<double>(b)).dot(normal) / square;
    const double along_b = -narrow<double>(a).cross(p.position).dot(normal) / square;
    const double lever = std::abs(along_a) + std::abs(along_b) + std::abs(1.0 - along_a - along_b);
    nearest.add({std::abs(offset) / std::sqrt(square),
                 (1.0 + lever) * rounding_,
                 (offset / square) * normal,
                 {f, kNone, kNone}});
  }
  return nearest;
}

Nearest<Candidate> EventSearch::onHorizon(std::size_t count) const {
  const auto mayAppear = [&](std::size_t polygon) { return !is_own_surface_[polygon]; };
  std::vector<bool> is_lit(points_.size(), false);
  std::vector<bool> counts(points_.size(), false);
  bool lit_above = false;
  bool lit_below = false;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    for (const std::size_t f : mesh_.edges()[e].faces) {
      const std::size_t polygon = mesh_.faces()[f].polygon;
      if (!mayAppear(polygon)) continue;
      for (const std::size_t point : {mesh_.edges()[e].start, mesh_.edges()[e].end}) {
        counts[point] = true;
        if (polygons_[polygon].radiance == 0.0) continue;
        is_lit[point] = true;
        lit_above = lit_above || points_[point].height > 0.0;
        lit_below = lit_below || points_[point].height <= 0.0;
      }
    }
  }
  Nearest<Candidate> nearest(count);
  for (std::size_t p = 0; p < points_.size(); ++p) {
    // What is black shows at the horizon only where something lit reaches down to it.
    if (!counts[p] || (!is_lit[p] && !(lit_above && lit_below))) continue;
    const double height = points_[p].height / normal_.norm();
    nearest.add({std::abs(height),
                 2.0 * rounding_ + 2.0 * kUnitRoundoff * points_[p].position.norm(),
                 height * normal_.normalized(),
                 {p, kNone, kNone}});
  }
  return nearest;
}

bool EventSearch::endsEdgeAlongHorizon(std::size_t point) const {
  return std::ranges::any_of(mesh_.edges(), [&](const MeshEdge& edge) {
    return (edge.start == point || edge.end == point) &&
           std::abs(points_[edge.start].height - points_[edge.end].height) <= 4.0 * rounding_;
  });
}

std::string EventSearch::describeFace(std::size_t face) const {
  const std::size_t polygon = mesh_.faces()[face].polygon;
  return "polygons[" + std::to_string(polygon) + "] \"" + polygons_[polygon].name + '"';
}

std::string EventSearch::describeEdge(std::size_t edge) const {
  const MeshEdge& e = mesh_.edges()[edge];
  return e.is_crease ? "the line in which " + describeFace(e.faces.front()) + " and " + describeFace(e.faces.back()) +
                           " pass through each other"
                     : "an edge of " + describeFace(e.faces.front());
}

std::string EventSearch::describePoint(std::size_t point) const {
  // Edges of faces come first: a point has the name of one of those if it ends there.
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const MeshEdge& edge = mesh_.edges()[e];
    if (edge.start != point && edge.end != point) continue;
    return edge.is_crease ? "an end of " + describeEdge(e) : "a vertex of " + describeFace(edge.faces.front());
  }
  return "a vertex";
}

}  // namespace

VisibilityEvents<3> nearestEvents(const SceneMesh& mesh, std::span<const Polygon> polygons,
                                  const std::vector<bool>& is_present, const std::vector<bool>& is_own_surface,
                                  const VisibleBoundary& view, const Receiver& receiver, std::size_t count) {
  const EventSearch search(mesh, polygons, is_present, is_own_surface, view, receiver);
  VisibilityEvents<3> events;
  using Ids = std::array<std::size_t, 3>;
  const auto jump = [](const Ids&) { return true; };
  const auto addAll = [&](EventKind kind, const Nearest<Candidate>& candidates, const auto& jumps,
                          const auto& describe) {
    for (const Candidate& candidate : candidates.items()) {
      VisibilityEvent<3> event;
      event.kind = kind;
      event.hessian_jumps = jumps(candidate.ids);
      event.distance = std::ldexp(candidate.distance, mesh.exponent());
      event.rounding = std::ldexp(candidate.rounding, mesh.exponent());
      event.displacement = candidate.displacement.unaryExpr([&](double c) { return std::ldexp(c, mesh.exponent()); });
      event.what = describe(candidate.ids);
      events.push_back(std::move(event));
    }
  };
  addAll(EventKind::kVertexOnEdge, search.verticesOnEdges(count), jump, [&](const Ids& ids) {
    return search.describePoint(ids[0]) + " meets " + search.describeEdge(ids[1]) + " in view";
  });
  addAll(EventKind::kThreeEdges, search.threeEdges(count), jump, [&](const Ids& ids) {
    return search.describeEdge(ids[0]) + ", " + search.describeEdge(ids[1]) + " and " + search.describeEdge(ids[2]) +
           " meet in view";
  });
  addAll(EventKind::kEdgeOn, search.edgeOn(count), jump,
         [&](const Ids& ids) { return search.describeFace(ids[0]) + " is seen edge-on"; });
  addAll(
      EventKind::kHorizon, search.onHorizon(count), [&](const Ids& ids) { return search.endsEdgeAlongHorizon(ids[0]); },
      [&](const Ids& ids) { return search.describePoint(ids[0]) + " reaches the horizon"; });
  addAll(
      EventKind::kHorizon, search.crossingsOnHorizon(count), [](const Ids&) { return false; },
      [&](const Ids& ids) {
        return search.describeEdge(ids[0]) + " and " + search.describeEdge(ids[1]) + " cross on the horizon";
      });
  std::ranges::stable_sort(events, {}, &VisibilityEvent<3>::distance);
  return events;
}

VisibilityEvents<3> SceneEvaluator::nearestEvents(const Receiver& receiver, std::size_t count) const {
  const Classification classified = classify(receiver);
  const VisibleBoundary view = viewOf(classified.is_present, receiver, grid_resolution_);
  std::vector<bool> is_own_surface;
  for (const PolygonEvaluation& polygon : classified.polygons) {
    is_own_surface.push_back(polygon.rule == PolygonRule::kOwnSurface);
  }
  return irradiff::nearestEvents(mesh_, polygons_, classified.is_present, is_own_surface, view, receiver, count);
}

}  // namespace irradiff
