#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <span>

namespace irradiff {

// Irradiance of a flatland scene at the receiver with its gradient, Hessian and rotational gradient, occlusion included
// (docs/derivations/flatland.md, section 5). Units W/m, W/m^2, W/m^3 for radiance in W/(m rad). Error: at most
// `bounds`, norm-wise. What is seen whole contributes as evaluateSegment() has it, what is seen in part as the segment
// between its two boundary points. Where the receiver is at a visibility event, or on the line of a segment it sees
// end-on, and the radiances make it matter, the gradient and the Hessian do not exist.
//
// Throws InvalidScene as evaluateSegment() and visibleParts() do, and if a result exceeds the range of double. Requires
// validated arguments.
SceneEvaluation<2> evaluateScene(std::span<const Segment> segments, const FlatlandReceiver& receiver);

}  // namespace irradiff
