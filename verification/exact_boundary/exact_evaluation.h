#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <vector>

namespace irradiff {

/// Irradiance of a scene with its derivatives from exact visibility and enclosures: slow, and right whatever the scene.
/// Values are the midpoints of balls of kDefaultPrecision bits rounded to double; a bound is the distance to the
/// farthest number that the ball contains.
///
/// Throws InvalidScene as exactVisibility() does, and as classifyPolygon() for a receiver on a polygon. The reasons for
/// missing derivatives are those of exactBoundary(), a polygon seen edge-on, hidden or not, and an edge on the horizon.
/// Requires validated arguments.
SceneEvaluation<3> evaluateExactly(const std::vector<Polygon>& polygons, const Receiver& receiver);

}  // namespace irradiff
