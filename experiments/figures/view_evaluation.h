#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/visible_boundary.h"

#include <functional>
#include <span>

namespace irradiff {

struct ViewEvaluation {
  SceneEvaluation<3> evaluation;
  VisibleBoundary topology;  ///< equal at two receivers that no visibility event separates
};

/// Evaluates a scene at one receiver. May be called from several threads at once.
using ViewEvaluator = std::function<ViewEvaluation(const Receiver&)>;

/// The library's evaluation of these polygons, which are copied. It throws InvalidScene where SceneEvaluator does.
/// Requires validated polygons.
ViewEvaluator viewEvaluator(std::span<const Polygon> polygons);

}  // namespace irradiff
