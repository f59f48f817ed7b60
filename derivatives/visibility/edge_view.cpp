#include "derivatives/visibility/edge_view.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/depth_order.h"
#include "derivatives/visibility/edges_in_line.h"

#include <algorithm>
#include <utility>

namespace irradiff {
namespace {

bool isOn(const FaceBeside& beside, EdgeSide side) { return side == EdgeSide::kRight ? beside.right : beside.left; }

/// The way along one edge.
class EdgeWalk {
 public:
  EdgeWalk(const SceneInView& scene, std::size_t edge, EdgeCrossings crossings)
      : scene_(scene), edge_(edge), crossings_(std::move(crossings)) {}

  EdgeView view();

 private:
  void addPiece(const EdgePlace& last);
  std::size_t nearestFace(const EdgeSpan& span, EdgeSide side) const;
  void markHidden(const EdgePiece& piece, const std::vector<std::size_t>& on_line);
  template <class MeetsOutline>
  Surroundings surroundingsAt(const EdgePlace& place, MeetsOutline meetsOutline) const;
  bool passesThrough(std::size_t face, const std::vector<EdgePlace>& places) const;

  const SceneInView& scene_;
  std::size_t edge_;
  EdgeCrossings crossings_;  ///< their faces as they are where the walk has come to
  EdgeView view_;
};

EdgeView EdgeWalk::view() {
  constexpr EdgePlace kStart{EdgePlace::Kind::kStart};
  constexpr EdgePlace kEnd{EdgePlace::Kind::kEnd};
  if (scene_.height(scene_.edge(edge_).start) >= 0) {
    view_.nodes.push_back(
        {{kStart}, surroundingsAt(kStart, [](const FaceBeside& beside) { return beside.meets_start; })});
  }
  for (EdgeCrossing& crossing : crossings_.crossings) {
    const EdgePlace place = crossing.places.front();
    const bool was_above = !view_.nodes.empty();
    if (was_above) addPiece(place);
    if (place.kind == EdgePlace::Kind::kHorizon) {
      view_.nodes.push_back({{place}, {}});
      if (was_above) return std::move(view_);
    } else if (was_above) {
      const Surroundings surroundings =
          surroundingsAt(place, [&](const FaceBeside& beside) { return passesThrough(beside.face, crossing.places); });
      view_.nodes.push_back({std::move(crossing.places), surroundings});
    }
    for (const FaceToggle& toggle : crossing.toggles) {
      FaceBeside& beside = crossings_.faces[toggle.beside];
      beside.left = beside.left != toggle.left;
      beside.right = beside.right != toggle.right;
    }
  }
  addPiece(kEnd);
  view_.nodes.push_back({{kEnd}, surroundingsAt(kEnd, [](const FaceBeside& beside) { return beside.meets_end; })});
  return std::move(view_);
}

/// From the last node to `last`.
void EdgeWalk::addPiece(const EdgePlace& last) {
  const EdgeSpan span{edge_, view_.nodes.back().places.front(), last};
  EdgePiece piece{nearestFace(span, EdgeSide::kLeft), nearestFace(span, EdgeSide::kRight)};
  piece.is_carrier = !isNearer(scene_, piece.left_face, span) || !isNearer(scene_, piece.right_face, span);
  std::vector<std::size_t> on_line;
  if (piece.is_carrier && !crossings_.in_line.empty()) {
    EdgesInLine in_line = edgesInLine(scene_, span, crossings_.in_line, crossings_.faces, piece);
    piece.is_carrier = in_line.is_carrier;
    on_line = std::move(in_line.on_line);
    if (view_.ambiguous_in_line == kNone) view_.ambiguous_in_line = in_line.ambiguous;
  }
  markHidden(piece, on_line);
  view_.pieces.push_back(piece);
}

std::size_t EdgeWalk::nearestFace(const EdgeSpan& span, EdgeSide side) const {
  std::size_t nearest = kNone;
  std::size_t rival = kNone;  // as near, but not as bright
  for (const FaceBeside& candidate : crossings_.faces) {
    if (!isOn(candidate, side)) continue;
    const int order = nearest == kNone ? 1 : compareFaces(scene_, span, side, candidate.face, nearest);
    if (order > 0) {
      nearest = candidate.face;
      rival = kNone;
    } else if (order == 0 && rival == kNone && scene_.radianceOf(candidate.face) != scene_.radianceOf(nearest)) {
      rival = candidate.face;
    }
  }
  if (rival != kNone) {
    const auto [first, second] =
        scene_.polygonOf(rival) < scene_.polygonOf(nearest) ? std::pair(rival, nearest) : std::pair(nearest, rival);
    throw InvalidScene(scene_.describeFace(first) + " and " + scene_.describeFace(second) +
                       " overlap in one plane with radiances " + std::to_string(scene_.radianceOf(first)) + " and " +
                       std::to_string(scene_.radianceOf(second)) + ": must be equal where polygons share a surface");
  }
  return nearest;
}

/// Polygons that end in view at the edge without an edge of their own, or do not show beside one of their own.
void EdgeWalk::markHidden(const EdgePiece& piece, const std::vector<std::size_t>& on_line) {
  const MeshEdge& e = scene_.edge(edge_);
  const std::size_t left = scene_.polygonOf(piece.left_face);
  const std::size_t right = scene_.polygonOf(piece.right_face);
  for (const FaceBeside& beside : crossings_.faces) {
    if (e.is_crease || std::ranges::find(e.faces, beside.face) == e.faces.end()) continue;
    const std::size_t own = scene_.polygonOf(beside.face);
    if ((beside.left && left != own) || (beside.right && right != own)) view_.partly_hidden.push_back(own);
  }
  if (!piece.is_carrier || left == right) return;
  for (const std::size_t polygon : {left, right}) {
    if (polygon == kNone) continue;
    const auto isOwn = [&](std::size_t edge) {
      const MeshEdge& line = scene_.edge(edge);
      return !line.is_crease &&
             std::ranges::any_of(line.faces, [&](std::size_t face) { return scene_.polygonOf(face) == polygon; });
    };
    if (!isOwn(edge_) && std::ranges::none_of(on_line, isOwn)) view_.partly_hidden.push_back(polygon);
  }
}

template <class MeetsOutline>
Surroundings EdgeWalk::surroundingsAt(const EdgePlace& place, MeetsOutline meetsOutline) const {
  const MeshEdge& e = scene_.edge(edge_);
  const EdgeSpan span{edge_, place, place};
  std::size_t nearest = kNone;
  bool has_left = false;
  bool has_right = false;
  for (const FaceBeside& candidate : crossings_.faces) {
    if (std::ranges::find(e.faces, candidate.face) != e.faces.end()) {
      has_left = has_left || candidate.left;
      has_right = has_right || candidate.right;
    } else if (candidate.left && candidate.right && !meetsOutline(candidate) &&
               (nearest == kNone || compareFaces(scene_, span, EdgeSide::kLeft, candidate.face, nearest) > 0)) {
      nearest = candidate.face;
    }
  }
  if (isNearer(scene_, nearest, span)) return {false, nearest};
  const bool is_end = place.kind == EdgePlace::Kind::kStart || place.kind == EdgePlace::Kind::kEnd;
  return {true, has_left && has_right && !is_end ? e.faces.front() : nearest};
}

/// Whether the outline of a face passes through a group of places: through one is through all.
bool EdgeWalk::passesThrough(std::size_t face, const std::vector<EdgePlace>& places) const {
  const MeshFace& f = scene_.face(face);
  return std::ranges::any_of(places, [&](const EdgePlace& place) {
    const std::vector<std::size_t>& ids = place.kind == EdgePlace::Kind::kPoint ? f.vertices : f.edges;
    return std::ranges::find(ids, place.id) != ids.end();
  });
}

}  // namespace

const Surroundings* EdgeView::whereItMeets(std::size_t other) const {
  const EdgePlace place{EdgePlace::Kind::kEdge, other};
  const auto node = std::ranges::find_if(
      nodes, [&](const EdgeNode& n) { return std::ranges::find(n.places, place) != n.places.end(); });
  return node == nodes.end() ? nullptr : &node->surroundings;
}

EdgeView viewAlong(const SceneInView& scene, std::size_t edge, EdgeCrossings crossings) {
  return EdgeWalk(scene, edge, std::move(crossings)).view();
}

}  // namespace irradiff
