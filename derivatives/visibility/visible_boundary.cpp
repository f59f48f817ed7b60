#include "derivatives/visibility/visible_boundary.h"

#include "derivatives/visibility/edge_crossings.h"
#include "derivatives/visibility/edge_view.h"
#include "derivatives/visibility/scene_in_view.h"
#include "derivatives/visibility/view_horizon.h"
#include "derivatives/visibility/visual_events.h"

#include <algorithm>
#include <utility>

namespace irradiff {
namespace {

ArcSides sidesOf(const SceneInView& scene, const EdgePiece& piece) {
  return {scene.polygonOf(piece.left_face), scene.polygonOf(piece.right_face)};
}

void addArcs(const SceneInView& scene, std::size_t edge, const EdgeView& view, std::vector<VisibleArc>& arcs) {
  for (std::size_t i = 0; i < view.pieces.size(); ++i) {
    const ArcSides sides = sidesOf(scene, view.pieces[i]);
    if (!view.pieces[i].is_carrier || sides.left == sides.right) continue;
    const EdgePlace& first = view.nodes[i].places.front();
    const EdgePlace& last = view.nodes[i + 1].places.front();
    // What crosses the edge without changing what is seen does not divide it.
    if (!arcs.empty() && arcs.back().edge == edge && arcs.back().last == first && arcs.back().sides == sides) {
      arcs.back().last = last;
    } else {
      arcs.push_back({edge, first, last, sides});
    }
  }
}

void addApparentVertices(const SceneInView& scene, std::size_t edge, std::span<const EdgeView> views,
                         std::vector<ApparentVertex>& vertices) {
  const EdgeView& view = views[edge];
  // What another edge on the same line carries is not this one's.
  const auto carriedBy = [&](const EdgePiece& piece) { return piece.is_carrier ? sidesOf(scene, piece) : ArcSides{}; };
  for (std::size_t node = 1; node + 1 < view.nodes.size(); ++node) {
    const std::vector<EdgePlace>& places = view.nodes[node].places;
    if (!view.nodes[node].surroundings.is_exposed) continue;
    const ArcSides before = carriedBy(view.pieces[node - 1]);
    const ArcSides after = carriedBy(view.pieces[node]);
    if (before == after) continue;
    const auto isExposedAt = [&](std::size_t other) {
      const Surroundings* of_other = views[other].whereItMeets(edge);
      return of_other != nullptr && of_other->is_exposed;
    };
    const auto nearer = std::ranges::find_if(places, [&](const EdgePlace& place) {
      return place.kind == EdgePlace::Kind::kEdge && scene.predicates().compareCrossing(edge, place.id) < 0 &&
             (places.size() == 1 || isExposedAt(place.id));
    });
    if (nearer != places.end()) vertices.push_back({edge, nearer->id, before, after});
  }
}

}  // namespace

VisibleBoundary visibleBoundary(const SceneMesh& mesh, std::span<const Polygon> polygons,
                                const std::vector<bool>& is_present, const ViewPredicates& view, int grid_resolution) {
  const SceneInView scene(mesh, polygons, is_present, view);
  EdgeCrossingFinder finder(scene, grid_resolution);
  std::vector<EdgeView> views(mesh.edges().size());
  std::vector<Alignment> at_ends;
  for (std::size_t e = 0; e < views.size(); ++e) {
    const bool rises = scene.height(mesh.edges()[e].start) > 0 || scene.height(mesh.edges()[e].end) > 0;
    if (!rises || !scene.isPresentEdge(e) || view.isRadial(e)) continue;
    EdgeCrossings crossings = finder.find(e);
    at_ends.insert(at_ends.end(), crossings.at_ends.begin(), crossings.at_ends.end());
    views[e] = viewAlong(scene, e, std::move(crossings));
  }

  VisibleBoundary boundary;
  boundary.is_seen.assign(polygons.size(), false);
  boundary.is_partly_hidden.assign(polygons.size(), false);
  for (std::size_t e = 0; e < views.size(); ++e) {
    addArcs(scene, e, views[e], boundary.arcs);
    addApparentVertices(scene, e, views, boundary.apparent_vertices);
    for (const std::size_t polygon : views[e].partly_hidden) boundary.is_partly_hidden[polygon] = true;
    if (views[e].ambiguous_in_line != kNone && !boundary.edges_in_line) {
      boundary.edges_in_line = scene.describeEdge(views[e].ambiguous_in_line) + " and " + scene.describeEdge(e) +
                               " lie over each other as seen from the receiver: one may hide the other or not";
    }
  }
  for (const VisibleArc& arc : boundary.arcs) {
    for (const std::size_t polygon : {arc.sides.left, arc.sides.right}) {
      if (polygon != kNone) boundary.is_seen[polygon] = true;
    }
  }
  boundary.meeting_in_view = visualEvent(scene, views, at_ends);
  boundary.crease_on_horizon = creaseOnHorizon(scene);
  boundary.horizon = placesOnHorizon(scene, boundary.arcs);
  return boundary;
}

}  // namespace irradiff
