#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <span>
#include <string>

namespace irradiff {

/// The same for segments in flatland.
SceneEvaluation<2> evaluateUnoccluded(std::span<const Segment> segments, const FlatlandReceiver& receiver);

}  // namespace irradiff
