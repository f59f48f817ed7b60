#include "experiments/figures/view_evaluation.h"

#include "derivatives/visibility/scene_evaluation.h"

#include <memory>

namespace irradiff {

ViewEvaluator viewEvaluator(std::span<const Polygon> polygons) {
  // A function is copied, its scene is not.
  const auto scene = std::make_shared<const SceneEvaluator>(polygons);
  return [scene](const Receiver& receiver) { return ViewEvaluation{scene->evaluate(receiver), scene->view(receiver)}; };
}

}  // namespace irradiff
