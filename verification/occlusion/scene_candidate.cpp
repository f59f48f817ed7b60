#include "verification/occlusion/scene_candidate.h"

namespace irradiff {

std::optional<Eigen::MatrixXd> SceneResult::get(Quantity quantity) const {
  switch (quantity) {
    case Quantity::kIrradiance:
      return Eigen::MatrixXd::Constant(1, 1, irradiance);
    case Quantity::kGradient:
      if (gradient) return *gradient;
      break;
    case Quantity::kHessian:
      if (hessian) return *hessian;
      break;
    default:
      break;
  }
  return std::nullopt;
}

SceneCandidate libraryEvaluator(ApparentVertices vertices) {
  return {vertices == ApparentVertices::kMove ? "SceneEvaluator" : "SceneEvaluator, apparent vertices fixed",
          [vertices](const OccludedScene& scene) {
            const SceneEvaluator evaluator(scene.polygons);
            const SceneEvaluation<3> sum = evaluator.evaluate(scene.receiver, evaluator.view(scene.receiver), vertices);
            SceneResult result{sum.derivatives.irradiance.value, {}, {}, sum.bounds};
            if (sum.no_gradient.empty()) result.gradient = sum.derivatives.gradient.value;
            if (sum.no_hessian.empty()) result.hessian = sum.derivatives.hessian.value;
            return result;
          }};
}

}  // namespace irradiff
