#pragma once

#include "derivatives/visibility/edge_crossings.h"
#include "derivatives/visibility/scene_in_view.h"
#include "derivatives/visibility/view_predicates.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// A part of an edge along which what is seen beside it does not change.
struct EdgePiece {
  std::size_t left_face = kNone;   ///< the nearest, or kNone
  std::size_t right_face = kNone;  ///< the same
  /// Nothing nearer hides the piece on both sides, and of edges that lie over each other it is the one that bounds what
  /// is seen.
  bool is_carrier = false;
};

/// What stays about a place of an edge however the receiver moves a little: a face around it whose outline does not
/// pass through that direction. Two faces that touch there may open between.
struct Surroundings {
  bool is_exposed = false;   ///< no such face hides the edge
  std::size_t face = kNone;  ///< the nearest, or one of the edge's own if those are on both sides of it, or kNone
};

/// Where pieces begin or end.
struct EdgeNode {
  std::vector<EdgePlace> places;  ///< in one direction
  Surroundings surroundings;      ///< on the horizon nothing is known: not exposed
};

/// What is seen along an edge, from its first place above the horizon to the last.
struct EdgeView {
  std::vector<EdgeNode> nodes;
  std::vector<EdgePiece> pieces;  ///< between consecutive nodes
  std::vector<std::size_t>
      partly_hidden;  ///< polygons that something nearer hides beside the edge; any number of times
  /// A nearer edge that lies over this one, where the one may hide the other or not and irradiance is not smooth; or
  /// kNone.
  std::size_t ambiguous_in_line = kNone;

  /// What is about this edge where it meets `other` in view, or nullptr where it is not followed.
  const Surroundings* whereItMeets(std::size_t other) const;
};

/// Follows an edge from its start past what crosses it. Requires that an end of the edge is above the horizon. Throws
/// InvalidScene, naming both, where two polygons of different radiance lie in one plane and are both the nearest.
EdgeView viewAlong(const SceneInView& scene, std::size_t edge, EdgeCrossings crossings);

}  // namespace irradiff
