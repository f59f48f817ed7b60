#include "derivatives/visibility/visual_events.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace irradiff {
namespace {

/// Looks for what meets in view.
class EventSearch {
 public:
  EventSearch(const SceneInView& scene, std::span<const EdgeView> views);

  /// What meets at a node of an edge that is not one of its ends, if the Hessian does not exist there.
  std::optional<std::string> atNode(std::size_t edge, std::size_t node) const;

  /// The same for two points in one direction.
  std::optional<std::string> atPoints(const Alignment& points) const;

 private:
  std::vector<std::size_t> edgesEndingAt(std::initializer_list<std::size_t> points) const;

  const SceneInView& scene_;
  std::span<const EdgeView> views_;
  std::vector<bool> is_exposed_point_;
};

bool areEqual(const std::vector<double>& radiances) {
  return std::ranges::all_of(radiances, [&](double radiance) { return radiance == radiances.front(); });
}

EventSearch::EventSearch(const SceneInView& scene, std::span<const EdgeView> views)
    : scene_(scene), views_(views), is_exposed_point_(scene.mesh().points().size(), false) {
  for (std::size_t e = 0; e < views.size(); ++e) {
    if (views[e].nodes.empty()) continue;
    if (views[e].nodes.front().surroundings.is_exposed) is_exposed_point_[scene.edge(e).start] = true;
    if (views[e].nodes.back().surroundings.is_exposed) is_exposed_point_[scene.edge(e).end] = true;
  }
}

/// Edges that count.
std::vector<std::size_t> EventSearch::edgesEndingAt(std::initializer_list<std::size_t> points) const {
  std::vector<std::size_t> edges;
  for (std::size_t e = 0; e < views_.size(); ++e) {
    const auto isEnd = [&](std::size_t point) { return scene_.edge(e).start == point || scene_.edge(e).end == point; };
    if (std::ranges::any_of(points, isEnd) && scene_.isPresentEdge(e)) edges.push_back(e);
  }
  return edges;
}

std::optional<std::string> EventSearch::atNode(std::size_t edge, std::size_t node) const {
  const ViewPredicates& predicates = scene_.predicates();
  const EdgeView& view = views_[edge];
  bool any_elsewhere = false;  // at another distance
  bool any_point = false;
  std::string other_name;
  std::vector<double> radiances;
  const auto addFaces = [&](std::size_t e) {
    for (const std::size_t f : scene_.edge(e).faces) {
      if (scene_.isPresentFace(f)) radiances.push_back(scene_.radianceOf(f));
    }
  };
  std::vector<std::size_t> exposed_edges;  // one for each line
  // A notch in a face behind a nearer one shows on neither side; what shows through it once it comes out counts too.
  std::size_t behind = view.nodes[node].surroundings.face;
  for (const EdgePlace& place : view.nodes[node].places) {
    if (place.kind == EdgePlace::Kind::kInLine) continue;
    if (place.kind == EdgePlace::Kind::kEdge) {
      const Surroundings* of_other = views_[place.id].whereItMeets(edge);
      if (of_other == nullptr || !of_other->is_exposed) continue;
      if (behind == kNone) behind = of_other->face;
      addFaces(place.id);
      if (std::ranges::any_of(exposed_edges, [&](std::size_t e) { return predicates.shareLine(e, place.id); })) {
        continue;
      }
      exposed_edges.push_back(place.id);
      if (predicates.compareCrossing(edge, place.id) == 0) continue;
      other_name = scene_.describeEdge(place.id);
    } else {
      if (!is_exposed_point_[place.id] || predicates.comparePoint(place.id, edge) == 0) continue;
      any_point = true;
      for (const std::size_t e : edgesEndingAt({place.id})) {
        addFaces(e);
        other_name = "an end of " + scene_.describeEdge(e);
      }
    }
    any_elsewhere = true;
  }
  if (!any_elsewhere || (!any_point && exposed_edges.size() == 1)) return std::nullopt;
  addFaces(edge);
  radiances.push_back(scene_.radianceOf(behind));
  for (const EdgePiece* piece : {&view.pieces[node - 1], &view.pieces[node]}) {
    radiances.push_back(scene_.radianceOf(piece->left_face));
    radiances.push_back(scene_.radianceOf(piece->right_face));
  }
  if (areEqual(radiances)) return std::nullopt;
  return scene_.describeEdge(edge) + " and " + other_name + " meet" + (any_point ? "" : " with a third edge") +
         " in one direction from the receiver";
}

std::optional<std::string> EventSearch::atPoints(const Alignment& points) const {
  if (scene_.height(points.first) <= 0 || !is_exposed_point_[points.first] || !is_exposed_point_[points.second] ||
      scene_.predicates().comparePoints(points.first, points.second) == 0) {
    return std::nullopt;
  }
  const std::vector<std::size_t> edges = edgesEndingAt({points.first, points.second});
  std::vector<double> radiances;
  for (const std::size_t e : edges) {
    for (const std::size_t f : scene_.edge(e).faces) radiances.push_back(scene_.radianceOf(f));
    const EdgeView& view = views_[e];
    if (view.pieces.empty()) continue;
    const auto addEnd = [&](std::size_t end, const EdgePiece& piece, const EdgeNode& node) {
      if (end != points.first && end != points.second) return;
      for (const std::size_t f : {piece.left_face, piece.right_face, node.surroundings.face}) {
        radiances.push_back(scene_.radianceOf(f));
      }
    };
    addEnd(scene_.edge(e).start, view.pieces.front(), view.nodes.front());
    addEnd(scene_.edge(e).end, view.pieces.back(), view.nodes.back());
  }
  if (areEqual(radiances)) return std::nullopt;
  return "ends of " + scene_.describeEdge(edges.front()) + " and of " + scene_.describeEdge(edges.back()) +
         " are in one direction from the receiver";
}

}  // namespace

std::optional<std::string> visualEvent(const SceneInView& scene, std::span<const EdgeView> views,
                                       std::span<const Alignment> at_ends) {
  const EventSearch search(scene, views);
  for (std::size_t e = 0; e < views.size(); ++e) {
    for (std::size_t node = 1; node + 1 < views[e].nodes.size(); ++node) {
      const auto& [places, surroundings] = views[e].nodes[node];
      const bool is_crossing = places.size() == 1 && places.front().kind == EdgePlace::Kind::kEdge;
      if (is_crossing || !surroundings.is_exposed) continue;
      if (std::optional<std::string> event = search.atNode(e, node)) return event;
    }
  }
  for (const Alignment& points : at_ends) {
    if (std::optional<std::string> event = search.atPoints(points)) return event;
  }
  return std::nullopt;
}

}  // namespace irradiff
