#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// A point of the scene at which what the receiver sees changes, or a direction of its horizon.
struct BoundaryPoint {
  enum class Kind {
    kEnd,       ///< vertex `end` of `segment`
    kCrossing,  ///< where `segment` and `other` pass through each other
    kHorizon,   ///< where `segment` is cut at the horizon
  };
  Kind kind = Kind::kHorizon;
  std::size_t segment = 0;
  std::size_t end = 0;
  std::size_t other = 0;
};

/// What is seen of a segment between two directions, `last` counterclockwise of `first`. The boundary points may belong
/// to segments in front of it.
struct VisiblePart {
  std::size_t segment = 0;
  BoundaryPoint first, last;
  bool is_whole = false;  ///< both points are its own: nothing hides any of it above the horizon
};

/// The front-most segments as seen from a receiver, above its horizon.
struct SegmentVisibility {
  std::vector<VisiblePart> parts;  ///< counterclockwise
  bool hides_something = false;    ///< some segment rises above the horizon, is not end-on and is not seen whole
  std::string no_gradient;         ///< why the gradient does not exist: a visibility event; empty if it does
  std::string no_hessian;          ///< the same for the Hessian, for ends on the horizon alone
};

/// Who is seen in which direction, by exact predicates: the combinatorics are those of the coordinates as given.
/// Segments radiate and block on both sides; where they pass through each other the front-most wins. `considered` are
/// the indices of the segments that take part, in ascending order: all but those on whose surface the receiver lies.
/// Throws InvalidScene, naming both, where segments of different radiance lie on one line and overlap in view.
/// O(n log n) for the front-most segments by merging halves in one angular sweep each, and O(n) for each direction in
/// which that changes. Requires validated arguments and a receiver on none of the segments considered.
/// docs/derivations/flatland.md, section 5.
SegmentVisibility visibleParts(std::span<const Segment> segments, std::span<const std::size_t> considered,
                               const FlatlandReceiver& receiver);

}  // namespace irradiff
