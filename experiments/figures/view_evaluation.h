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
  IrradianceHessian<double>
      gap_filled_hessian;    ///< with apparent vertices fixed, as section 4.1 of the 2012 paper has it
  VisibleBoundary topology;  ///< what bounds different radiances: equal at receivers that no event of those separates
};

/// Evaluates a scene at one receiver. May be called from several threads at once.
using ViewEvaluator = std::function<ViewEvaluation(const Receiver&)>;

/// The library's evaluation of these polygons, which are copied. It throws InvalidScene where SceneEvaluator does.
/// Requires validated polygons.
ViewEvaluator viewEvaluator(std::span<const Polygon> polygons);

}  // namespace irradiff
