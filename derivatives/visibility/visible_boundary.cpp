#include "derivatives/visibility/visible_boundary.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/view_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace irradiff {
namespace {

/// Where something crosses the great circle of the edge that is followed.
struct CircleLocation {
  bool is_ahead = false;      ///< within the half circle that begins at the edge's start
  bool is_at_start = false;   ///< in the direction of the edge's start, or opposite
  bool is_at_end = false;     ///< in the direction of the edge's end, or opposite
  std::size_t event = kNone;  ///< index of the event, if it is between the edge's ends
};

/// A place between the ends of the edge that is followed, with an interval that contains its parameter.
struct Event {
  EdgePlace place;
  double lower;
  double upper;
};

/// The sides of the followed edge on which a face begins or ceases to be at an event.
struct Toggle {
  std::size_t event;
  std::size_t candidate;
  bool left;
  bool right;
};

/// A face that may be seen beside the followed edge, and whether it is at the current piece, near or hidden.
struct Candidate {
  std::size_t face;
  bool left = false;
  bool right = false;
  bool meets_start = false;  ///< its outline may pass through the direction of the edge's start
  bool meets_end = false;
};

/// A part of an edge along which what is seen beside it does not change.
struct Piece {
  std::size_t first_group;  ///< it ends at the next group
  std::size_t left_face;    ///< the nearest, or kNone
  std::size_t right_face;
  bool is_exposed;  ///< nothing nearer hides it on both sides
  bool is_carrier;  ///< among edges in one line, the one that bounds what is seen
};

/// What stays about a place of an edge however the receiver moves a little: a face around it whose outline does not
/// pass through that direction. Two faces that touch there may open between.
struct Surroundings {
  bool is_exposed;   ///< no such face hides the edge
  std::size_t face;  ///< the nearest, or one of the edge's own if those are on both sides of it, or kNone
};

/// What following an edge has found, from its first place above the horizon to the last.
struct EdgeView {
  std::vector<std::vector<EdgePlace>> groups;  ///< places in one direction
  std::vector<Piece> pieces;                   ///< between consecutive groups
  std::vector<Surroundings> surroundings;      ///< of groups
};

/// Two points in one direction.
struct Alignment {
  std::size_t first;
  std::size_t second;
};

class BoundaryTracer {
 public:
  BoundaryTracer(const SceneMesh& mesh, std::span<const Polygon> polygons, const std::vector<bool>& is_present,
                 const ViewPredicates& view, int grid_resolution)
      : mesh_(mesh),
        polygons_(polygons),
        is_present_(is_present),
        view_(view),
        grid_(mesh, view.position(), view.normal(), grid_resolution) {}

  VisibleBoundary trace();

 private:
  bool isPresent(const MeshEdge& edge) const;
  std::size_t polygonOf(std::size_t face) const { return face == kNone ? kNone : mesh_.faces()[face].polygon; }
  double radianceOf(std::size_t polygon) const { return polygon == kNone ? 0.0 : polygons_[polygon].radiance; }
  std::string describe(std::size_t polygon) const;
  std::string describeEdge(std::size_t edge) const;

  void followEdge(std::size_t edge);
  void addFace(std::size_t edge, std::size_t face);
  void addCrease(std::size_t edge, std::size_t crease);
  void addInLine(std::size_t edge, std::size_t other);
  int sideOf(std::size_t edge, std::size_t point);
  CircleLocation crossingAt(std::size_t edge, std::size_t other);
  CircleLocation pointAt(std::size_t edge, std::size_t point);
  std::size_t addEvent(std::size_t edge, const EdgePlace& place);
  std::size_t firstPolygonAt(const EdgePlace& place) const;
  std::vector<std::vector<std::size_t>> sortedEvents(std::size_t edge);
  void cutIntoPieces(std::size_t edge);
  Piece pieceAt(std::size_t edge, const EdgePlace& first, const EdgePlace& last);
  std::size_t nearestFace(std::size_t edge, const EdgePlace& first, const EdgePlace& last, bool right) const;
  int compareFaces(std::size_t edge, const EdgePlace& first, const EdgePlace& last, bool right, std::size_t a,
                   std::size_t b) const;
  bool isNearer(std::size_t face, std::size_t edge, const EdgePlace& first, const EdgePlace& last) const;
  void findCarrier(std::size_t edge, const EdgePlace& first, const EdgePlace& last, Piece& piece);
  bool isSmoothInLine(std::size_t far, std::size_t near, const EdgePlace& first, const EdgePlace& last,
                      const Piece& piece) const;
  void markHidden(std::size_t edge, const Piece& piece);
  template <class MeetsOutline>
  Surroundings surroundingsAt(std::size_t edge, const EdgePlace& place, MeetsOutline meetsOutline) const;
  bool passesThrough(std::size_t face, const std::vector<EdgePlace>& places) const;

  void collectArcs(std::size_t edge);
  void collectVertices(std::size_t edge);
  void judgeMeeting(std::size_t edge, std::size_t group);
  void judgeAlignments();
  const Surroundings* surroundingsAtCrossing(std::size_t edge, std::size_t other) const;
  bool isExposedAt(std::size_t edge, std::size_t other) const;
  void collectHorizon();
  static std::optional<HorizonPlace> netChange(std::span<const std::pair<int, HorizonPlace>> places);

  const SceneMesh& mesh_;
  std::span<const Polygon> polygons_;
  const std::vector<bool>& is_present_;
  const ViewPredicates& view_;

  ViewGrid grid_;                           ///< of the faces of polygons that are present, and of their creases
  std::vector<int> receiver_offset_;        ///< of each face
  std::vector<int> height_;                 ///< of each point
  std::vector<std::size_t> first_polygon_;  ///< of those whose edges end in a point
  std::vector<EdgeView> views_;             ///< of each edge
  std::vector<bool> is_exposed_point_;
  std::vector<Alignment> alignments_;
  VisibleBoundary boundary_;

  // Of the edge that is followed.
  std::vector<std::size_t> near_faces_, near_creases_;
  std::vector<Candidate> candidates_;
  std::vector<Event> events_;
  std::vector<Toggle> toggles_;
  std::vector<std::size_t> in_line_;           ///< edges in the same plane of view
  std::vector<std::size_t> covering_in_line_;  ///< those of them that lie over the current piece
  std::vector<std::size_t> on_line_;           ///< those of these that are on one line with it
  std::vector<std::size_t> side_stamp_, point_stamp_, edge_stamp_;
  std::vector<std::int8_t> side_;
  std::vector<CircleLocation> point_location_, edge_location_;
  std::size_t stamp_ = 0;
};

bool BoundaryTracer::isPresent(const MeshEdge& edge) const {
  const auto present = [&](std::size_t face) { return is_present_[mesh_.faces()[face].polygon]; };
  return edge.is_crease ? std::ranges::all_of(edge.faces, present) : std::ranges::any_of(edge.faces, present);
}

std::string BoundaryTracer::describe(std::size_t polygon) const {
  return "polygons[" + std::to_string(polygon) + "] \"" + polygons_[polygon].name + '"';
}

std::string BoundaryTracer::describeEdge(std::size_t edge) const {
  const MeshEdge& e = mesh_.edges()[edge];
  const std::size_t polygon = mesh_.faces()[e.faces.front()].polygon;
  if (e.is_crease) {
    return "the line in which " + describe(polygon) + " and " + describe(mesh_.faces()[e.faces.back()].polygon) +
           " pass through each other";
  }
  return "an edge of " + describe(polygon);
}

VisibleBoundary BoundaryTracer::trace() {
  const std::size_t edge_count = mesh_.edges().size();
  const std::size_t point_count = mesh_.points().size();
  boundary_.is_seen.assign(polygons_.size(), false);
  boundary_.is_partly_hidden.assign(polygons_.size(), false);
  receiver_offset_.assign(mesh_.faces().size(), 0);
  for (std::size_t f = 0; f < mesh_.faces().size(); ++f) {
    if (!is_present_[mesh_.faces()[f].polygon]) continue;
    grid_.insertFace(f);
    receiver_offset_[f] = view_.receiverOffset(f);
  }
  for (std::size_t c = mesh_.firstCrease(); c < edge_count; ++c) {
    if (isPresent(mesh_.edges()[c])) grid_.insertCrease(c);
  }
  first_polygon_.assign(point_count, kNone);
  for (const MeshEdge& edge : mesh_.edges()) {
    for (const std::size_t p : {edge.start, edge.end}) {
      first_polygon_[p] = std::min(first_polygon_[p], polygonOf(edge.faces.front()));
    }
  }
  height_.resize(point_count);
  for (std::size_t p = 0; p < point_count; ++p) height_[p] = view_.height(p);
  views_.resize(edge_count);
  is_exposed_point_.assign(point_count, false);
  side_stamp_.assign(point_count, 0);
  point_stamp_.assign(point_count, 0);
  edge_stamp_.assign(edge_count, 0);
  side_.resize(point_count);
  point_location_.resize(point_count);
  edge_location_.resize(edge_count);

  for (std::size_t e = 0; e < edge_count; ++e) {
    if (isPresent(mesh_.edges()[e])) followEdge(e);
  }
  for (std::size_t e = 0; e < edge_count; ++e) {
    collectArcs(e);
    collectVertices(e);
  }
  judgeAlignments();
  collectHorizon();
  return std::move(boundary_);
}

void BoundaryTracer::followEdge(std::size_t edge) {
  const MeshEdge& e = mesh_.edges()[edge];
  if (e.is_crease && height_[e.start] == 0 && height_[e.end] == 0 && !boundary_.crease_on_horizon &&
      radianceOf(polygonOf(e.faces.front())) != radianceOf(polygonOf(e.faces.back()))) {
    boundary_.crease_on_horizon =
        describeEdge(edge) + " lies on the receiver's horizon: the second derivative along the normal is one-sided";
  }
  if ((height_[e.start] <= 0 && height_[e.end] <= 0) || view_.isRadial(edge)) return;
  ++stamp_;
  candidates_.clear();
  events_.clear();
  toggles_.clear();
  in_line_.clear();
  near_faces_.clear();
  near_creases_.clear();
  grid_.collect(edge, near_faces_, near_creases_);
  for (const std::size_t f : near_faces_) addFace(edge, f);
  for (const std::size_t c : near_creases_) {
    if (c != edge) addCrease(edge, c);
  }
  if (height_[e.start] * height_[e.end] < 0) addEvent(edge, {EdgePlace::Kind::kHorizon});
  cutIntoPieces(edge);
}

int BoundaryTracer::sideOf(std::size_t edge, std::size_t point) {
  if (side_stamp_[point] != stamp_) {
    side_stamp_[point] = stamp_;
    side_[point] = static_cast<std::int8_t>(view_.side(edge, point));
  }
  return side_[point];
}

void BoundaryTracer::addFace(std::size_t edge, std::size_t face) {
  const MeshFace& f = mesh_.faces()[face];
  bool any_left = false;
  bool any_right = false;
  for (const std::size_t v : f.vertices) {
    const int side = sideOf(edge, v);
    any_left = any_left || side <= 0;
    any_right = any_right || side >= 0;
  }
  if (!any_left || !any_right) return;

  // The face as it is crossed by two curves, just left and just right of the edge: to the left one what lies in the
  // edge's plane of view is on the right, to the right one on the left. So neither curve meets a vertex, and each
  // crossing takes it into the face or out.
  const std::size_t candidate = candidates_.size();
  bool left = false;
  bool right = false;
  bool meets_start = false;
  bool meets_end = false;
  for (std::size_t i = 0; i < f.vertices.size(); ++i) {
    if (f.edges[i] == edge) continue;
    const std::size_t p = f.vertices[i];
    const std::size_t q = f.vertices[(i + 1) % f.vertices.size()];
    const int side_p = sideOf(edge, p);
    const int side_q = sideOf(edge, q);
    if (side_p == 0) {
      const CircleLocation location = pointAt(edge, p);
      meets_start = meets_start || location.is_at_start;
      meets_end = meets_end || location.is_at_end;
    }
    if (side_p == 0 && side_q == 0) {
      addInLine(edge, f.edges[i]);
      meets_start = meets_end = true;
      continue;
    }
    const bool crosses_left = (side_p < 0) != (side_q < 0);
    const bool crosses_right = (side_p > 0) != (side_q > 0);
    if (!crosses_left && !crosses_right) continue;
    const CircleLocation location =
        side_p * side_q < 0 ? crossingAt(edge, f.edges[i]) : pointAt(edge, side_p == 0 ? p : q);
    meets_start = meets_start || location.is_at_start;
    meets_end = meets_end || location.is_at_end;
    left = left != (crosses_left && location.is_ahead);
    right = right != (crosses_right && location.is_ahead);
    if (location.event != kNone) toggles_.push_back({location.event, candidate, crosses_left, crosses_right});
  }
  // An odd number of crossings in the half circle ahead: the start is in the face, or opposite to it.
  if ((left || right) && !view_.runsTowards(mesh_.edges()[edge].start, face)) left = right = false;
  candidates_.push_back({face, left, right, meets_start, meets_end});
}

void BoundaryTracer::addCrease(std::size_t edge, std::size_t crease) {
  const MeshEdge& c = mesh_.edges()[crease];
  const int start = sideOf(edge, c.start);
  const int end = sideOf(edge, c.end);
  if (start == 0) pointAt(edge, c.start);
  if (end == 0) pointAt(edge, c.end);
  if (start == 0 && end == 0) addInLine(edge, crease);
  if (start * end < 0) crossingAt(edge, crease);
}

void BoundaryTracer::addInLine(std::size_t edge, std::size_t other) {
  if (other == edge || std::ranges::find(in_line_, other) != in_line_.end() || view_.isRadial(other) ||
      !isPresent(mesh_.edges()[other])) {
    return;
  }
  in_line_.push_back(other);
  // So that their order in depth does not change within a piece.
  if (view_.passThroughInLine(edge, other)) addEvent(edge, {EdgePlace::Kind::kInLine, other});
}

CircleLocation BoundaryTracer::crossingAt(std::size_t edge, std::size_t other) {
  if (edge_stamp_[other] == stamp_) return edge_location_[other];
  edge_stamp_[other] = stamp_;
  const MeshEdge& e = mesh_.edges()[edge];
  // The direction of the crossing is that of the cross product of both planes of view, turned so that it is on `other`.
  const int turn = sideOf(edge, mesh_.edges()[other].start);
  const int start_side = view_.side(other, e.start);
  const int end_side = view_.side(other, e.end);
  CircleLocation location{turn * start_side < 0, start_side == 0, end_side == 0, kNone};
  if (location.is_ahead && turn * end_side > 0) location.event = addEvent(edge, {EdgePlace::Kind::kEdge, other});
  return edge_location_[other] = location;
}

CircleLocation BoundaryTracer::pointAt(std::size_t edge, std::size_t point) {
  if (point_stamp_[point] == stamp_) return point_location_[point];
  point_stamp_[point] = stamp_;
  const MeshEdge& e = mesh_.edges()[edge];
  CircleLocation location{point == e.end, point == e.start, point == e.end, kNone};
  if (point != e.start && point != e.end) {
    const EdgePlace place{EdgePlace::Kind::kPoint, point};
    const PlaceWeights<int> signs = view_.weightSigns(edge, place);
    location.is_ahead = signs.end > 0;
    location.is_at_start = signs.end == 0;
    location.is_at_end = signs.start == 0;
    if (signs.start > 0 && signs.end > 0) location.event = addEvent(edge, place);
    if (signs.end == 0 && signs.start > 0) alignments_.push_back({point, e.start});
    if (signs.start == 0 && signs.end > 0) alignments_.push_back({point, e.end});
  }
  return point_location_[point] = location;
}

std::size_t BoundaryTracer::addEvent(std::size_t edge, const EdgePlace& place) {
  const PlaceWeights<BoundedNumber> weights = view_.weights<BoundedNumber>(edge, place);
  const double start_low = std::max(weights.start.value() - weights.start.error(), 0.0);
  const double end_low = std::max(weights.end.value() - weights.end.error(), 0.0);
  const double start_high = weights.start.value() + weights.start.error();
  const double end_high = weights.end.value() + weights.end.error();
  // Sum and quotient round; a weight that is not finite leaves the interval open.
  constexpr double kRounding = 0x1p-50;
  Event event{place, 0.0, 1.0};
  if (start_high > 0.0 && end_high > 0.0 && std::isfinite(start_high) && std::isfinite(end_high)) {
    event.lower = end_low / (end_low + start_high) - kRounding;
    event.upper = end_high / (end_high + start_low) + kRounding;
  }
  events_.push_back(event);
  return events_.size() - 1;
}

/// Events in the order in which they lie on the edge, those in one direction together.
std::vector<std::vector<std::size_t>> BoundaryTracer::sortedEvents(std::size_t edge) {
  std::vector<std::size_t> order(events_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto compare = [&](std::size_t a, std::size_t b) {
    if (events_[a].upper < events_[b].lower) return -1;
    if (events_[b].upper < events_[a].lower) return 1;
    return view_.compare(edge, events_[a].place, events_[b].place);
  };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return compare(a, b) < 0; });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t event : order) {
    if (groups.empty() || compare(groups.back().front(), event) < 0) groups.emplace_back();
    groups.back().push_back(event);
  }
  return groups;
}

/// The first of the polygons that make a place; kNone for the horizon.
std::size_t BoundaryTracer::firstPolygonAt(const EdgePlace& place) const {
  if (place.kind == EdgePlace::Kind::kPoint) return first_polygon_[place.id];
  return place.id == kNone ? kNone : polygonOf(mesh_.edges()[place.id].faces.front());
}

void BoundaryTracer::cutIntoPieces(std::size_t edge) {
  const MeshEdge& e = mesh_.edges()[edge];
  EdgeView& result = views_[edge];
  const std::vector<std::vector<std::size_t>> groups = sortedEvents(edge);
  std::vector<std::vector<Toggle>> toggles(events_.size());
  for (const Toggle& toggle : toggles_) toggles[toggle.event].push_back(toggle);

  bool is_above = height_[e.start] >= 0;
  EdgePlace place{EdgePlace::Kind::kStart};
  std::vector<EdgePlace> places{place};
  for (std::size_t g = 0; g <= groups.size(); ++g) {
    const EdgePlace next = g < groups.size() ? events_[groups[g].front()].place : EdgePlace{EdgePlace::Kind::kEnd};
    if (is_above) {
      if (result.groups.empty()) {
        result.groups.push_back(places);
        result.surroundings.push_back(
            place.kind == EdgePlace::Kind::kStart
                ? surroundingsAt(edge, place, [](const Candidate& candidate) { return candidate.meets_start; })
                : Surroundings{false, kNone});
      }
      Piece piece = pieceAt(edge, place, next);
      piece.first_group = result.groups.size() - 1;
      result.pieces.push_back(piece);
    }
    places.clear();
    Surroundings surroundings{false, kNone};
    if (g == groups.size()) {
      places.push_back(next);
      surroundings = surroundingsAt(edge, next, [](const Candidate& candidate) { return candidate.meets_end; });
    } else {
      for (const std::size_t event : groups[g]) places.push_back(events_[event].place);
      // What happens on the horizon counts for nothing else there.
      const auto horizon = std::ranges::find(places, EdgePlace::Kind::kHorizon, &EdgePlace::kind);
      if (horizon != places.end()) {
        places = {*horizon};
        is_above = !is_above;
      }
      // The first stands for all, and must not depend on what was looked at first, nor on polygons that come after.
      std::ranges::sort(places, {}, [&](const EdgePlace& p) { return std::tuple(firstPolygonAt(p), p.kind, p.id); });
      if (horizon == places.end()) {
        surroundings = surroundingsAt(
            edge, next, [&](const Candidate& candidate) { return passesThrough(candidate.face, places); });
      }
      for (const std::size_t event : groups[g]) {
        for (const Toggle& toggle : toggles[event]) {
          Candidate& candidate = candidates_[toggle.candidate];
          candidate.left = candidate.left != toggle.left;
          candidate.right = candidate.right != toggle.right;
        }
      }
    }
    if (!result.groups.empty() && result.pieces.size() == result.groups.size()) {
      result.groups.push_back(places);
      result.surroundings.push_back(surroundings);
    }
    place = places.front();
  }
  if (result.pieces.empty()) return;
  if (result.surroundings.front().is_exposed) is_exposed_point_[e.start] = true;
  if (result.surroundings.back().is_exposed) is_exposed_point_[e.end] = true;
}

template <class MeetsOutline>
Surroundings BoundaryTracer::surroundingsAt(std::size_t edge, const EdgePlace& place, MeetsOutline meetsOutline) const {
  const MeshEdge& e = mesh_.edges()[edge];
  std::size_t nearest = kNone;
  bool has_left = false;
  bool has_right = false;
  for (const Candidate& candidate : candidates_) {
    if (std::ranges::find(e.faces, candidate.face) != e.faces.end()) {
      has_left = has_left || candidate.left;
      has_right = has_right || candidate.right;
    } else if (candidate.left && candidate.right && !meetsOutline(candidate) &&
               (nearest == kNone || compareFaces(edge, place, place, false, candidate.face, nearest) > 0)) {
      nearest = candidate.face;
    }
  }
  if (isNearer(nearest, edge, place, place)) return {false, nearest};
  const bool is_end = place.kind == EdgePlace::Kind::kStart || place.kind == EdgePlace::Kind::kEnd;
  return {true, has_left && has_right && !is_end ? e.faces.front() : nearest};
}

/// Whether the outline of a face passes through a group of places: through one is through all.
bool BoundaryTracer::passesThrough(std::size_t face, const std::vector<EdgePlace>& places) const {
  const MeshFace& f = mesh_.faces()[face];
  return std::ranges::any_of(places, [&](const EdgePlace& place) {
    const std::vector<std::size_t>& ids = place.kind == EdgePlace::Kind::kPoint ? f.vertices : f.edges;
    return std::ranges::find(ids, place.id) != ids.end();
  });
}

/// 1 where face a is nearer than b beside a piece, -1 where b is, 0 where they lie in one plane.
int BoundaryTracer::compareFaces(std::size_t edge, const EdgePlace& first, const EdgePlace& last, bool right,
                                 std::size_t a, std::size_t b) const {
  const PlaneSide side_a = mesh_.sideOfPlane(a, b);
  if (side_a == PlaneSide::kInPlane) return 0;
  if (side_a != PlaneSide::kCrosses) return static_cast<int>(side_a) == receiver_offset_[b] ? 1 : -1;
  const PlaneSide side_b = mesh_.sideOfPlane(b, a);
  if (side_b != PlaneSide::kCrosses) return static_cast<int>(side_b) == receiver_offset_[a] ? -1 : 1;
  if (const int at_first = view_.compareFaces(edge, first, a, b); at_first != 0) return at_first;
  if (const int at_last = view_.compareFaces(edge, last, a, b); at_last != 0) return at_last;
  const int beside = view_.compareFacesRight(edge, a, b);
  return right ? beside : -beside;
}

std::size_t BoundaryTracer::nearestFace(std::size_t edge, const EdgePlace& first, const EdgePlace& last,
                                        bool right) const {
  std::size_t nearest = kNone;
  for (const Candidate& candidate : candidates_) {
    if (!(right ? candidate.right : candidate.left)) continue;
    if (nearest == kNone || compareFaces(edge, first, last, right, candidate.face, nearest) > 0) {
      nearest = candidate.face;
    }
  }
  if (nearest == kNone) return kNone;
  for (const Candidate& candidate : candidates_) {
    if (!(right ? candidate.right : candidate.left) || candidate.face == nearest) continue;
    const std::size_t a = polygonOf(nearest);
    const std::size_t b = polygonOf(candidate.face);
    if (a != b && radianceOf(a) != radianceOf(b) &&
        compareFaces(edge, first, last, right, candidate.face, nearest) == 0) {
      throw InvalidScene(describe(std::min(a, b)) + " and " + describe(std::max(a, b)) +
                         " overlap in one plane with radiances " + std::to_string(radianceOf(std::min(a, b))) +
                         " and " + std::to_string(radianceOf(std::max(a, b))) +
                         ": must be equal where polygons share a surface");
    }
  }
  return nearest;
}

/// Whether a face that is seen beside a piece of the edge is nearer than the edge.
bool BoundaryTracer::isNearer(std::size_t face, std::size_t edge, const EdgePlace& first, const EdgePlace& last) const {
  if (face == kNone) return false;
  const MeshEdge& e = mesh_.edges()[edge];
  if (std::ranges::find(e.faces, face) != e.faces.end()) return false;
  const int start = mesh_.planeOffset(face, e.start) * receiver_offset_[face];
  const int end = mesh_.planeOffset(face, e.end) * receiver_offset_[face];
  if (start >= 0 && end >= 0) return false;
  if (start <= 0 && end <= 0) return true;
  const int at_first = view_.compareDepth(edge, first, face);
  return (at_first != 0 ? at_first : view_.compareDepth(edge, last, face)) < 0;
}

Piece BoundaryTracer::pieceAt(std::size_t edge, const EdgePlace& first, const EdgePlace& last) {
  Piece piece{};
  piece.left_face = nearestFace(edge, first, last, false);
  piece.right_face = nearestFace(edge, first, last, true);
  piece.is_exposed = !isNearer(piece.left_face, edge, first, last) || !isNearer(piece.right_face, edge, first, last);
  piece.is_carrier = piece.is_exposed;
  covering_in_line_.clear();
  on_line_.clear();
  if (piece.is_exposed && !in_line_.empty()) findCarrier(edge, first, last, piece);
  markHidden(edge, piece);
  return piece;
}

/// Among edges that lie over each other along an exposed piece, the nearest bounds what is seen, and of those on one
/// line the first.
void BoundaryTracer::findCarrier(std::size_t edge, const EdgePlace& first, const EdgePlace& last, Piece& piece) {
  std::ranges::copy_if(in_line_, std::back_inserter(covering_in_line_),
                       [&](std::size_t other) { return view_.covers(other, edge, first, last); });
  for (const std::size_t other : covering_in_line_) {
    const int order = view_.compareInLine(edge, other, first, last);
    if (order == 0) on_line_.push_back(other);
    if (order < 0 || (order == 0 && other < edge)) piece.is_carrier = false;
    if (order < 0 && !boundary_.edges_in_line && !isSmoothInLine(edge, other, first, last, piece)) {
      boundary_.edges_in_line = describeEdge(other) + " and " + describeEdge(edge) +
                                " lie over each other as seen from the receiver: one may hide the other or not";
    }
  }
}

/// Whether irradiance is smooth although an edge lies over a farther one: what comes to be seen between them, on
/// whichever side, is as bright as what is seen on that side now, so that the farther edge bounds nothing.
bool BoundaryTracer::isSmoothInLine(std::size_t far, std::size_t near, const EdgePlace& first, const EdgePlace& last,
                                    const Piece& piece) const {
  const double left = radianceOf(polygonOf(piece.left_face));
  const double right = radianceOf(polygonOf(piece.right_face));
  const MeshEdge& f = mesh_.edges()[far];
  const MeshEdge& n = mesh_.edges()[near];
  const auto contains = [](const MeshEdge& e, std::size_t face) {
    return std::ranges::find(e.faces, face) != e.faces.end();
  };
  std::size_t behind = kNone;  // the nearest face that lies over both sides and has neither edge
  std::size_t far_left = kNone;
  std::size_t far_right = kNone;
  for (const Candidate& candidate : candidates_) {
    const bool of_far = contains(f, candidate.face);
    const bool of_near = contains(n, candidate.face);
    const auto isNearest = [&](std::size_t face, bool on_right) {
      return face == kNone || compareFaces(far, first, last, on_right, candidate.face, face) > 0;
    };
    if (of_far && candidate.left && isNearest(far_left, false)) far_left = candidate.face;
    if (of_far && candidate.right && isNearest(far_right, true)) far_right = candidate.face;
    if (candidate.left && candidate.right && !of_far && !of_near && isNearest(behind, false)) behind = candidate.face;
  }
  // A face seen edge-on between them shows itself on both sides, a crease or a third edge more than this looks at: then
  // everything about must be equally bright.
  bool is_plain = !f.is_crease && !n.is_crease && covering_in_line_.size() == 1;
  std::vector<std::size_t> polygons{polygonOf(behind)};
  for (const MeshEdge* e : {&f, &n}) {
    for (const std::size_t face : e->faces) {
      if (!is_present_[polygonOf(face)]) continue;
      polygons.push_back(polygonOf(face));
      is_plain = is_plain && receiver_offset_[face] != 0;
    }
  }
  if (!is_plain) {
    return left == right &&
           std::ranges::all_of(polygons, [&](std::size_t polygon) { return radianceOf(polygon) == left; });
  }
  // The near edge's own faces hide the strip on their side; where it has none, the strip shows the far edge's face on
  // the other side of that, or what is behind.
  const auto beside = [&](std::size_t face) { return radianceOf(polygonOf(face == kNone ? behind : face)); };
  const bool near_has_left =
      std::ranges::any_of(candidates_, [&](const Candidate& c) { return c.left && contains(n, c.face); });
  const bool near_has_right =
      std::ranges::any_of(candidates_, [&](const Candidate& c) { return c.right && contains(n, c.face); });
  const double strip_left = near_has_left ? left : beside(far_right);
  const double strip_right = near_has_right ? right : beside(far_left);
  return strip_left == left && strip_right == right;
}

void BoundaryTracer::markHidden(std::size_t edge, const Piece& piece) {
  const MeshEdge& e = mesh_.edges()[edge];
  for (const Candidate& candidate : candidates_) {
    if (e.is_crease || std::ranges::find(e.faces, candidate.face) == e.faces.end()) continue;
    const std::size_t own = polygonOf(candidate.face);
    if ((candidate.left && polygonOf(piece.left_face) != own) ||
        (candidate.right && polygonOf(piece.right_face) != own)) {
      boundary_.is_partly_hidden[own] = true;
    }
  }
  const std::size_t left = polygonOf(piece.left_face);
  const std::size_t right = polygonOf(piece.right_face);
  if (!piece.is_carrier || left == right) return;
  for (const std::size_t polygon : {left, right}) {
    if (polygon == kNone) continue;
    boundary_.is_seen[polygon] = true;
    const auto bounds = [&](const MeshEdge& line) {
      return !line.is_crease && std::ranges::any_of(line.faces, [&](std::size_t f) { return polygonOf(f) == polygon; });
    };
    const bool is_own =
        bounds(e) || std::ranges::any_of(on_line_, [&](std::size_t other) { return bounds(mesh_.edges()[other]); });
    if (!is_own) boundary_.is_partly_hidden[polygon] = true;
  }
}

void BoundaryTracer::collectArcs(std::size_t edge) {
  const EdgeView& view = views_[edge];
  for (std::size_t i = 0; i < view.pieces.size(); ++i) {
    const Piece& piece = view.pieces[i];
    const ArcSides sides{polygonOf(piece.left_face), polygonOf(piece.right_face)};
    if (!piece.is_carrier || sides.left == sides.right) continue;
    const EdgePlace& first = view.groups[i].front();
    const EdgePlace& last = view.groups[i + 1].front();
    // What crosses the edge without changing what is seen does not divide it.
    if (!boundary_.arcs.empty() && boundary_.arcs.back().edge == edge && boundary_.arcs.back().last == first &&
        boundary_.arcs.back().sides == sides) {
      boundary_.arcs.back().last = last;
    } else {
      boundary_.arcs.push_back({edge, first, last, sides});
    }
  }
}

/// What is about `edge` where it meets `other` in view, or nullptr where it is not followed.
const Surroundings* BoundaryTracer::surroundingsAtCrossing(std::size_t edge, std::size_t other) const {
  const EdgeView& view = views_[edge];
  for (std::size_t g = 0; g < view.groups.size(); ++g) {
    if (std::ranges::find(view.groups[g], EdgePlace{EdgePlace::Kind::kEdge, other}) != view.groups[g].end()) {
      return &view.surroundings[g];
    }
  }
  return nullptr;
}

bool BoundaryTracer::isExposedAt(std::size_t edge, std::size_t other) const {
  const Surroundings* surroundings = surroundingsAtCrossing(edge, other);
  return surroundings != nullptr && surroundings->is_exposed;
}

void BoundaryTracer::collectVertices(std::size_t edge) {
  const EdgeView& view = views_[edge];
  for (std::size_t g = 1; g + 1 < view.groups.size(); ++g) {
    if (!view.surroundings[g].is_exposed) continue;
    const std::vector<EdgePlace>& places = view.groups[g];
    if (places.size() > 1 || places.front().kind != EdgePlace::Kind::kEdge) {
      judgeMeeting(edge, g);
    }
    // What another edge on the same line carries is not this one's.
    const auto sidesOf = [&](const Piece& piece) {
      return piece.is_carrier ? ArcSides{polygonOf(piece.left_face), polygonOf(piece.right_face)} : ArcSides{};
    };
    const ArcSides before = sidesOf(view.pieces[g - 1]);
    const ArcSides after = sidesOf(view.pieces[g]);
    if (before == after) continue;
    for (const EdgePlace& place : places) {
      if (place.kind == EdgePlace::Kind::kEdge && view_.compareCrossing(edge, place.id) < 0 &&
          (places.size() == 1 || isExposedAt(place.id, edge))) {
        boundary_.apparent_vertices.push_back({edge, place.id, before, after});
        break;
      }
    }
  }
}

/// Several edges, or a point, on one place of an edge: whether the Hessian exists there.
void BoundaryTracer::judgeMeeting(std::size_t edge, std::size_t group) {
  if (boundary_.meeting_in_view) return;
  const EdgeView& view = views_[edge];
  std::size_t elsewhere = 0;
  bool any_point = false;
  std::string other_name;
  std::vector<std::size_t> polygons;
  const auto addFaces = [&](std::size_t e) {
    for (const std::size_t f : mesh_.edges()[e].faces) {
      if (is_present_[polygonOf(f)]) polygons.push_back(polygonOf(f));
    }
  };
  std::vector<std::size_t> exposed_edges;  // one for each line
  // A notch in a face behind a nearer one shows on neither side; what shows through it once it comes out counts too.
  std::size_t behind = view.surroundings[group].face;
  for (const EdgePlace& place : view.groups[group]) {
    if (place.kind == EdgePlace::Kind::kInLine) continue;
    if (place.kind == EdgePlace::Kind::kEdge) {
      const Surroundings* of_other = surroundingsAtCrossing(place.id, edge);
      if (of_other == nullptr || !of_other->is_exposed) continue;
      if (behind == kNone) behind = of_other->face;
      addFaces(place.id);
      if (std::ranges::any_of(exposed_edges, [&](std::size_t e) { return view_.shareLine(e, place.id); })) continue;
      exposed_edges.push_back(place.id);
      if (view_.compareCrossing(edge, place.id) == 0) continue;
      other_name = describeEdge(place.id);
    } else {
      if (!is_exposed_point_[place.id] || view_.comparePoint(place.id, edge) == 0) continue;
      any_point = true;
      for (std::size_t e = 0; e < mesh_.edges().size(); ++e) {
        if ((mesh_.edges()[e].start == place.id || mesh_.edges()[e].end == place.id) && isPresent(mesh_.edges()[e])) {
          addFaces(e);
          other_name = "an end of " + describeEdge(e);
        }
      }
    }
    ++elsewhere;
  }
  if (elsewhere == 0 || (!any_point && exposed_edges.size() == 1)) return;
  addFaces(edge);
  polygons.push_back(polygonOf(behind));
  for (const Piece* piece : {&view.pieces[group - 1], &view.pieces[group]}) {
    polygons.push_back(polygonOf(piece->left_face));
    polygons.push_back(polygonOf(piece->right_face));
  }
  if (std::ranges::any_of(polygons, [&](std::size_t p) { return radianceOf(p) != radianceOf(polygons[0]); })) {
    boundary_.meeting_in_view = describeEdge(edge) + " and " + other_name + " meet" +
                                (any_point ? "" : " with a third edge") + " in one direction from the receiver";
  }
}

void BoundaryTracer::judgeAlignments() {
  for (const Alignment& alignment : alignments_) {
    if (boundary_.meeting_in_view) return;
    if (height_[alignment.first] <= 0 || !is_exposed_point_[alignment.first] || !is_exposed_point_[alignment.second] ||
        view_.comparePoints(alignment.first, alignment.second) == 0) {
      continue;
    }
    std::vector<std::size_t> edges;
    for (std::size_t e = 0; e < mesh_.edges().size(); ++e) {
      const MeshEdge& candidate = mesh_.edges()[e];
      const bool ends_here = candidate.start == alignment.first || candidate.end == alignment.first ||
                             candidate.start == alignment.second || candidate.end == alignment.second;
      if (ends_here && isPresent(candidate)) edges.push_back(e);
    }
    std::vector<double> radiances{};
    for (const std::size_t e : edges) {
      for (const std::size_t f : mesh_.edges()[e].faces) radiances.push_back(radianceOf(polygonOf(f)));
      const EdgeView& view = views_[e];
      if (view.pieces.empty()) continue;
      const auto addEnd = [&](const Piece& piece, const Surroundings& surroundings) {
        radiances.push_back(radianceOf(polygonOf(piece.left_face)));
        radiances.push_back(radianceOf(polygonOf(piece.right_face)));
        radiances.push_back(radianceOf(polygonOf(surroundings.face)));
      };
      const auto isHere = [&](std::size_t point) { return point == alignment.first || point == alignment.second; };
      if (isHere(mesh_.edges()[e].start)) addEnd(view.pieces.front(), view.surroundings.front());
      if (isHere(mesh_.edges()[e].end)) addEnd(view.pieces.back(), view.surroundings.back());
    }
    if (std::ranges::any_of(radiances, [&](double radiance) { return radiance != radiances[0]; })) {
      boundary_.meeting_in_view = "ends of " + describeEdge(edges.front()) + " and of " + describeEdge(edges.back()) +
                                  " are in one direction from the receiver";
    }
  }
}

void BoundaryTracer::collectHorizon() {
  std::vector<HorizonPlace>& places = boundary_.horizon;
  for (const VisibleArc& arc : boundary_.arcs) {
    const MeshEdge& e = mesh_.edges()[arc.edge];
    const auto meets = [&](const EdgePlace& place, std::size_t end, EdgePlace::Kind kind) {
      return place.kind == EdgePlace::Kind::kHorizon || (place.kind == kind && height_[end] == 0);
    };
    if (meets(arc.first, e.start, EdgePlace::Kind::kStart)) {
      places.push_back({arc.edge, arc.first, arc.sides.right, arc.sides.left});
    }
    if (meets(arc.last, e.end, EdgePlace::Kind::kEnd)) {
      places.push_back({arc.edge, arc.last, arc.sides.left, arc.sides.right});
    }
  }
  if (places.empty()) return;
  const HorizonPlace origin = places.front();
  const auto turn = [&](const HorizonPlace& a, const HorizonPlace& b) {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
      return determinant(view_.normal<Number>(), view_.direction<Number>(a.edge, a.place),
                         view_.direction<Number>(b.edge, b.place));
    });
  };
  const auto isBehind = [&](const HorizonPlace& a) {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
             return dot(view_.direction<Number>(origin.edge, origin.place), view_.direction<Number>(a.edge, a.place));
           }) < 0;
  };
  // 0 in the direction of the origin, 1 in the half circle after it, 2 opposite, 3 beyond.
  const auto quarter = [&](const HorizonPlace& a) {
    const int side = turn(origin, a);
    if (side > 0) return 1;
    if (side < 0) return 3;
    return isBehind(a) ? 2 : 0;
  };
  std::vector<std::pair<int, HorizonPlace>> keyed;
  keyed.reserve(places.size());
  for (const HorizonPlace& place : places) keyed.emplace_back(quarter(place), place);
  std::ranges::stable_sort(keyed, [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    return a.first % 2 == 1 && turn(a.second, b.second) > 0;
  });
  places.clear();
  for (std::size_t first = 0; first < keyed.size();) {
    std::size_t last = first + 1;
    while (last < keyed.size() && keyed[last].first == keyed[first].first &&
           (keyed[first].first % 2 == 0 || turn(keyed[first].second, keyed[last].second) == 0)) {
      ++last;
    }
    if (const std::optional<HorizonPlace> net = netChange(std::span(keyed).subspan(first, last - first))) {
      places.push_back(*net);
    }
    first = last;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].counterclockwise != places[(i + 1) % places.size()].clockwise) {
      throw std::logic_error("visibleBoundary: what is seen along the horizon does not connect");
    }
  }
}

/// What places in one direction change together: the polygon that comes in and the one that goes out; nothing where the
/// same polygon lies on both sides.
std::optional<HorizonPlace> BoundaryTracer::netChange(std::span<const std::pair<int, HorizonPlace>> places) {
  std::vector<std::size_t> incoming;
  std::vector<std::size_t> outgoing;
  for (const auto& [key, place] : places) {
    incoming.push_back(place.clockwise);
    outgoing.push_back(place.counterclockwise);
  }
  for (auto polygon = incoming.begin(); polygon != incoming.end();) {
    const auto same = std::ranges::find(outgoing, *polygon);
    if (same == outgoing.end()) {
      ++polygon;
    } else {
      outgoing.erase(same);
      polygon = incoming.erase(polygon);
    }
  }
  if (incoming.empty()) return std::nullopt;
  const HorizonPlace& first = places.front().second;
  return HorizonPlace{first.edge, first.place, incoming.front(), outgoing.front()};
}

}  // namespace

VisibleBoundary visibleBoundary(const SceneMesh& mesh, std::span<const Polygon> polygons,
                                const std::vector<bool>& is_present, const ViewPredicates& view, int grid_resolution) {
  return BoundaryTracer(mesh, polygons, is_present, view, grid_resolution).trace();
}

}  // namespace irradiff
