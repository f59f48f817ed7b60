#pragma once

#include "derivatives/boundary/visibility_event.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <cstddef>
#include <span>

namespace irradiff {

/// The nearest visibility events of a receiver in flatland, at most `count` of each kind: two ends or crossings in line
/// with it, the nearer one being seen; a segment that is seen end-on; an end on the horizon. Whoever moves by less than
/// the distance of the first sees the same points of the same segments; it may be the same beyond too, where what would
/// meet is hidden. Segments on which the receiver stands stay out of sight however it moves.
///
/// In double: distances are right to 1e-12 of the farthest end's. O(n^2) for the crossings of n segments, and O(n) for
/// each point that is seen. Throws InvalidScene as evaluateScene does. docs/derivations/flatland.md, section 7.
VisibilityEvents<2> nearestEvents(std::span<const Segment> segments, const FlatlandReceiver& receiver,
                                  std::size_t count);

}  // namespace irradiff
