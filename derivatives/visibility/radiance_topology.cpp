#include "derivatives/visibility/radiance_topology.h"

#include <algorithm>
#include <cstddef>

namespace irradiff {
namespace {

/// The first polygon of the same radiance; kNone for a black one and for kNone.
std::size_t representative(std::size_t polygon, std::span<const double> radiances) {
  if (polygon == kNone || radiances[polygon] == 0.0) {
    return kNone;
  }
  return static_cast<std::size_t>(std::ranges::find(radiances, radiances[polygon]) - radiances.begin());
}

ArcSides representatives(const ArcSides& sides, std::span<const double> radiances) {
  return {representative(sides.left, radiances), representative(sides.right, radiances)};
}

bool areAlike(const ArcSides& sides) { return sides.left == sides.right; }

/// Adds an arc, or lengthens the last one where that goes on in it.
void appendArc(std::vector<VisibleArc>& arcs, const VisibleArc& arc) {
  if (!arcs.empty() && arcs.back().edge == arc.edge && arcs.back().sides == arc.sides &&
      arcs.back().last == arc.first) {
    arcs.back().last = arc.last;
  } else {
    arcs.push_back(arc);
  }
}

}  // namespace

VisibleBoundary radianceTopology(const VisibleBoundary& view, std::span<const double> radiances) {
  VisibleBoundary topology;
  for (VisibleArc arc : view.arcs) {
    arc.sides = representatives(arc.sides, radiances);
    if (!areAlike(arc.sides)) {
      appendArc(topology.arcs, arc);
    }
  }
  for (ApparentVertex vertex : view.apparent_vertices) {
    vertex.before = representatives(vertex.before, radiances);
    vertex.after = representatives(vertex.after, radiances);
    const bool shows = !areAlike(vertex.before) || !areAlike(vertex.after);
    if (shows && !(vertex.before == vertex.after)) {
      topology.apparent_vertices.push_back(vertex);
    }
  }
  for (HorizonPlace place : view.horizon) {
    place.clockwise = representative(place.clockwise, radiances);
    place.counterclockwise = representative(place.counterclockwise, radiances);
    if (place.clockwise != place.counterclockwise) {
      topology.horizon.push_back(place);
    }
  }
  topology.edges_in_line = view.edges_in_line;
  topology.meeting_in_view = view.meeting_in_view;
  return topology;
}

}  // namespace irradiff
