#pragma once

#include "derivatives/boundary/visibility_event.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/scene_mesh.h"
#include "derivatives/visibility/visible_boundary.h"

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// The nearest visibility events of a receiver, at most `count` of each kind. Whoever moves by less than the distance
/// of the first sees the same topology; it may be the same beyond too, where what would meet is hidden.
///
/// What enters is the mesh, the view of it and which of the polygons are there for the receiver: `is_present` those
/// that may hide others, `is_own_surface` those it stands on, which stay out of sight however it moves. What leaves is
/// in metres. In double, with determinants in doubled precision: distances are right to 1e-12 of themselves or 2^-90 of
/// the farthest vertex's. O(n) for each edge and vertex that is seen, and for each apparent vertex.
/// docs/derivations/visibility.md, section 6.
VisibilityEvents<3> nearestEvents(const SceneMesh& mesh, std::span<const Polygon> polygons,
                                  const std::vector<bool>& is_present, const std::vector<bool>& is_own_surface,
                                  const VisibleBoundary& view, const Receiver& receiver, std::size_t count);

}  // namespace irradiff
