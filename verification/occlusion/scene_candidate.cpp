#include "verification/occlusion/scene_candidate.h"

namespace irradiff {

const char* nameOf(SceneQuantity quantity) {
  switch (quantity) {
    case SceneQuantity::kIrradiance:
      return "irradiance";
    case SceneQuantity::kGradient:
      return "gradient";
    case SceneQuantity::kHessian:
      return "hessian";
  }
  return "";
}

std::optional<Eigen::MatrixXd> SceneResult::get(SceneQuantity quantity) const {
  switch (quantity) {
    case SceneQuantity::kIrradiance:
      return Eigen::MatrixXd::Constant(1, 1, irradiance);
    case SceneQuantity::kGradient:
      if (gradient) return *gradient;
      break;
    case SceneQuantity::kHessian:
      if (hessian) return *hessian;
      break;
  }
  return std::nullopt;
}

double boundOf(const DerivativeBounds& bounds, SceneQuantity quantity) {
  switch (quantity) {
    case SceneQuantity::kIrradiance:
      return bounds.irradiance;
    case SceneQuantity::kGradient:
      return bounds.gradient;
    case SceneQuantity::kHessian:
      return bounds.hessian;
  }
  return 0.0;
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
