#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/unoccluded_scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace irradiff {

/// What is seen from a receiver, without its measures: two receivers on the same side of every visibility event have
/// equal ones.
using ViewTopology = std::vector<std::int8_t>;

struct ViewEvaluation {
  SceneEvaluation<3> evaluation;
  ViewTopology topology;
};

/// Evaluates a scene at one receiver. May be called from several threads at once.
using ViewEvaluator = std::function<ViewEvaluation(const Receiver&)>;

/// The library's evaluation of these polygons. It throws InvalidScene where evaluateUnoccluded does. Over a plane whose
/// normal is everywhere the same, such a scene has one kind of event: the receiver crosses the plane of a polygon.
ViewEvaluator viewEvaluator(std::vector<Polygon> polygons);

}  // namespace irradiff
