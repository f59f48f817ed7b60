#include "derivatives/visibility/edge_crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace irradiff {

EdgeCrossingFinder::EdgeCrossingFinder(const SceneInView& scene, int grid_resolution)
    : scene_(scene),
      predicates_(scene.predicates()),
      grid_(scene.mesh(), predicates_.position(), predicates_.normal(), grid_resolution),
      side_stamp_(scene.mesh().points().size(), 0),
      point_stamp_(scene.mesh().points().size(), 0),
      edge_stamp_(scene.mesh().edges().size(), 0),
      side_(scene.mesh().points().size()),
      point_location_(scene.mesh().points().size()),
      edge_location_(scene.mesh().edges().size()) {
  for (std::size_t f = 0; f < scene.mesh().faces().size(); ++f) {
    if (scene.isPresentFace(f)) grid_.insertFace(f);
  }
  for (std::size_t c = scene.mesh().firstCrease(); c < scene.mesh().edges().size(); ++c) {
    if (scene.isPresentEdge(c)) grid_.insertCrease(c);
  }
}

EdgeCrossings EdgeCrossingFinder::find(std::size_t edge) {
  edge_ = edge;
  ++stamp_;
  events_.clear();
  toggles_.clear();
  near_faces_.clear();
  near_creases_.clear();
  grid_.collect(edge, near_faces_, near_creases_);
  for (const std::size_t f : near_faces_) addFace(f);
  for (const std::size_t c : near_creases_) {
    if (c != edge) addCrease(c);
  }
  const MeshEdge& e = scene_.edge(edge);
  if (scene_.height(e.start) * scene_.height(e.end) < 0) addEvent({EdgePlace::Kind::kHorizon});
  orderEvents();
  return std::exchange(found_, {});
}

int EdgeCrossingFinder::sideOf(std::size_t point) {
  if (side_stamp_[point] != stamp_) {
    side_stamp_[point] = stamp_;
    side_[point] = static_cast<std::int8_t>(predicates_.side(edge_, point));
  }
  return side_[point];
}

void EdgeCrossingFinder::addFace(std::size_t face) {
  const MeshFace& f = scene_.face(face);
  bool any_left = false;
  bool any_right = false;
  for (const std::size_t v : f.vertices) {
    const int side = sideOf(v);
    any_left = any_left || side <= 0;
    any_right = any_right || side >= 0;
  }
  if (!any_left || !any_right) return;

  // The face as it is crossed by two curves, just left and just right of the edge: to the left one what lies in the
  // edge's plane of view is on the right, to the right one on the left. So neither curve meets a vertex, and each
  // crossing takes it into the face or out.
  FaceBeside beside{face};
  for (std::size_t i = 0; i < f.vertices.size(); ++i) {
    if (f.edges[i] == edge_) continue;
    const std::size_t p = f.vertices[i];
    const std::size_t q = f.vertices[(i + 1) % f.vertices.size()];
    const int side_p = sideOf(p);
    const int side_q = sideOf(q);
    if (side_p == 0) {
      const CircleLocation location = pointAt(p);
      beside.meets_start = beside.meets_start || location.is_at_start;
      beside.meets_end = beside.meets_end || location.is_at_end;
    }
    if (side_p == 0 && side_q == 0) {
      addInLine(f.edges[i]);
      beside.meets_start = beside.meets_end = true;
      continue;
    }
    const bool crosses_left = (side_p < 0) != (side_q < 0);
    const bool crosses_right = (side_p > 0) != (side_q > 0);
    if (!crosses_left && !crosses_right) continue;
    const CircleLocation location = side_p * side_q < 0 ? crossingAt(f.edges[i]) : pointAt(side_p == 0 ? p : q);
    beside.meets_start = beside.meets_start || location.is_at_start;
    beside.meets_end = beside.meets_end || location.is_at_end;
    beside.left = beside.left != (crosses_left && location.is_ahead);
    beside.right = beside.right != (crosses_right && location.is_ahead);
    if (location.event != kNone) {
      toggles_.push_back({location.event, {found_.faces.size(), crosses_left, crosses_right}});
    }
  }
  // An odd number of crossings in the half circle ahead: the start is in the face, or opposite to it.
  if ((beside.left || beside.right) && !predicates_.runsTowards(scene_.edge(edge_).start, face)) {
    beside.left = beside.right = false;
  }
  found_.faces.push_back(beside);
}

void EdgeCrossingFinder::addCrease(std::size_t crease) {
  const MeshEdge& c = scene_.edge(crease);
  const int start = sideOf(c.start);
  const int end = sideOf(c.end);
  if (start == 0) pointAt(c.start);
  if (end == 0) pointAt(c.end);
  if (start == 0 && end == 0) addInLine(crease);
  if (start * end < 0) crossingAt(crease);
}

void EdgeCrossingFinder::addInLine(std::size_t other) {
  if (other == edge_ || std::ranges::find(found_.in_line, other) != found_.in_line.end() ||
      predicates_.isRadial(other) || !scene_.isPresentEdge(other)) {
    return;
  }
  found_.in_line.push_back(other);
  // So that their order in depth does not change between two crossings.
  if (predicates_.passThroughInLine(edge_, other)) addEvent({EdgePlace::Kind::kInLine, other});
}

EdgeCrossingFinder::CircleLocation EdgeCrossingFinder::crossingAt(std::size_t other) {
  if (edge_stamp_[other] == stamp_) return edge_location_[other];
  edge_stamp_[other] = stamp_;
  const MeshEdge& e = scene_.edge(edge_);
  // The direction of the crossing is that of the cross product of both planes of view, turned so that it is on `other`.
  const int turn = sideOf(scene_.edge(other).start);
  const int start_side = predicates_.side(other, e.start);
  const int end_side = predicates_.side(other, e.end);
  CircleLocation location{turn * start_side < 0, start_side == 0, end_side == 0, kNone};
  if (location.is_ahead && turn * end_side > 0) location.event = addEvent({EdgePlace::Kind::kEdge, other});
  return edge_location_[other] = location;
}

EdgeCrossingFinder::CircleLocation EdgeCrossingFinder::pointAt(std::size_t point) {
  if (point_stamp_[point] == stamp_) return point_location_[point];
  point_stamp_[point] = stamp_;
  const MeshEdge& e = scene_.edge(edge_);
  CircleLocation location{point == e.end, point == e.start, point == e.end, kNone};
  if (point != e.start && point != e.end) {
    const EdgePlace place{EdgePlace::Kind::kPoint, point};
    const PlaceWeights<int> signs = predicates_.weightSigns(edge_, place);
    location.is_ahead = signs.end > 0;
    location.is_at_start = signs.end == 0;
    location.is_at_end = signs.start == 0;
    if (signs.start > 0 && signs.end > 0) location.event = addEvent(place);
    if (signs.end == 0 && signs.start > 0) found_.at_ends.push_back({point, e.start});
    if (signs.start == 0 && signs.end > 0) found_.at_ends.push_back({point, e.end});
  }
  return point_location_[point] = location;
}

std::size_t EdgeCrossingFinder::addEvent(const EdgePlace& place) {
  const PlaceWeights<BoundedNumber> weights = predicates_.weights<BoundedNumber>(edge_, place);
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

/// Makes crossings of the events.
std::size_t EdgeCrossingFinder::firstPolygonAt(const EdgePlace& place) const {
  if (place.kind == EdgePlace::Kind::kPoint) return scene_.firstPolygonAt(place.id);
  return place.id == kNone ? kNone : scene_.polygonOf(scene_.edge(place.id).faces.front());
}

void EdgeCrossingFinder::orderEvents() {
  std::vector<std::size_t> order(events_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto compare = [&](std::size_t a, std::size_t b) {
    if (events_[a].upper < events_[b].lower) return -1;
    if (events_[b].upper < events_[a].lower) return 1;
    return predicates_.compare(edge_, events_[a].place, events_[b].place);
  };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return compare(a, b) < 0; });

  std::vector<EdgeCrossing>& crossings = found_.crossings;
  std::vector<std::size_t> crossing_of(events_.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || compare(order[i - 1], order[i]) < 0) crossings.emplace_back();
    crossings.back().places.push_back(events_[order[i]].place);
    crossing_of[order[i]] = crossings.size() - 1;
  }
  for (EdgeCrossing& crossing : crossings) {
    const auto horizon = std::ranges::find(crossing.places, EdgePlace::Kind::kHorizon, &EdgePlace::kind);
    if (horizon != crossing.places.end()) crossing.places = {*horizon};
    std::ranges::sort(crossing.places, {}, [this](const EdgePlace& place) {
      return std::tuple(firstPolygonAt(place), place.kind, place.id);
    });
  }
  for (const EventToggle& of_event : toggles_) {
    crossings[crossing_of[of_event.event]].toggles.push_back(of_event.toggle);
  }
}

}  // namespace irradiff
