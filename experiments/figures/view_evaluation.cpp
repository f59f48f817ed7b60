#include "experiments/figures/view_evaluation.h"

#include "derivatives/visibility/radiance_topology.h"
#include "derivatives/visibility/scene_evaluation.h"

#include <memory>
#include <vector>

namespace irradiff {
ViewEvaluator viewEvaluator(std::span<const Polygon> polygons) {
  // A function is copied, its scene is not.
  const auto scene = std::make_shared<const SceneEvaluator>(polygons);
  std::vector<double> radiances;
  for (const Polygon& polygon : polygons) {
    radiances.push_back(polygon.radiance);
  }
  return [scene, radiances](const Receiver& receiver) {
    const VisibleBoundary view = scene->view(receiver);
    return ViewEvaluation{scene->evaluate(receiver, view, ApparentVertices::kMove),
                          scene->evaluate(receiver, view, ApparentVertices::kFixed).derivatives.hessian,
                          radianceTopology(view, radiances)};
  };
}

}  // namespace irradiff
