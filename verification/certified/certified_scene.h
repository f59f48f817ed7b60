#pragma once

#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/certified_result.h"

namespace irradiff {

/// Decides what is seen without rounding, as SceneEvaluator does, and lets each source climb until the bounds of the
/// sum meet `tolerance` (rung.h). A derivative that does not exist is not waited for. Throws InvalidScene as
/// SceneEvaluator::evaluate does, and std::invalid_argument for a tolerance outside [kSmallestTolerance, 1].
CertifiedScene<3> certifyScene(const SceneEvaluator& evaluator, const Receiver& receiver, double tolerance);

}  // namespace irradiff
