#pragma once

#include "derivatives/visibility/scene_mesh.h"
#include "derivatives/visibility/view_predicates.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// What is seen just beside an arc: an index of the scene's polygons, or kNone for the background.
struct ArcSides {
  std::size_t left = kNone;
  std::size_t right = kNone;

  bool operator==(const ArcSides&) const = default;
};

/// A piece of an edge of the mesh, above the horizon, at which one polygon ends in view and another, or the background,
/// begins. `first` comes before `last` along the edge.
struct VisibleArc {
  std::size_t edge;
  EdgePlace first;
  EdgePlace last;
  ArcSides sides;

  bool operator==(const VisibleArc&) const = default;
};

/// Where an edge passes behind another in view, and what is seen beside it changes.
struct ApparentVertex {
  std::size_t farther;  ///< edge
  std::size_t nearer;   ///< edge
  ArcSides before;      ///< beside the farther edge where it comes to the vertex
  ArcSides after;       ///< and where it leaves it

  bool operator==(const ApparentVertex&) const = default;
};

/// A place of the horizon at which what is seen just above it changes; `edge` is one of those that end there.
struct HorizonPlace {
  std::size_t edge;
  EdgePlace place;
  std::size_t clockwise = kNone;         ///< seen from above
  std::size_t counterclockwise = kNone;  ///< seen from above

  bool operator==(const HorizonPlace&) const = default;
};

/// Everything about a view that is not a number: which pieces of which edges bound what is seen, and where it may
/// change abruptly. Two receivers with equal boundaries see the same topology.
struct VisibleBoundary {
  std::vector<VisibleArc> arcs;
  std::vector<ApparentVertex> apparent_vertices;
  std::vector<HorizonPlace> horizon;   ///< counterclockwise
  std::vector<bool> is_seen;           ///< of each polygon: some of it is the nearest
  std::vector<bool> is_partly_hidden;  ///< of each polygon: something else is nearer where it would be seen
  /// Two edges at different distances lie over each other in view, and the radiances about them differ: the gradient
  /// does not exist.
  std::optional<std::string> edges_in_line;
  /// Three edges, or an edge and a foreign vertex, or two vertices meet in view: the Hessian does not exist.
  std::optional<std::string> meeting_in_view;
  /// The Hessian along the normal does not exist.
  std::optional<std::string> crease_on_horizon;

  bool operator==(const VisibleBoundary&) const = default;
};

/// Which polygons are seen from a receiver, and what bounds them.
///
/// The nearest polygon wins, also where polygons pass through each other. `is_present` tells the polygons that count;
/// those on which the receiver stands do not. Throws InvalidScene, naming both, where two polygons of different
/// radiance lie over each other in one plane and are both the nearest. Requires that the receiver is on no edge of a
/// polygon that counts.
///
/// `grid_resolution`, at least 1, is that of the ViewGrid by which pairs far apart in view are left out: the boundary
/// is the same for any.
///
/// Each edge is followed from its start: what crosses it in view, exactly and in exact order, divides it into pieces
/// along which the polygons beside it do not change. docs/derivations/visibility.md.
VisibleBoundary visibleBoundary(const SceneMesh& mesh, std::span<const Polygon> polygons,
                                const std::vector<bool>& is_present, const ViewPredicates& view, int grid_resolution);

}  // namespace irradiff
