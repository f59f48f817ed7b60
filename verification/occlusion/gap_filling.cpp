#include "verification/occlusion/gap_filling.h"

#include "derivatives/visibility/scene_evaluation.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

std::vector<double> gapFillingErrors(const SceneFamily& family, std::size_t count, std::uint64_t seed) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < count; ++i) {
    const OccludedScene scene = drawScene(family, seed, i);
    const SceneEvaluator evaluator(scene.polygons);
    const SceneEvaluation<3> moving = evaluator.evaluate(scene.receiver);
    if (!moving.has_occlusion || !moving.no_hessian.empty()) continue;
    const SceneEvaluation<3> fixed =
        evaluator.evaluate(scene.receiver, PolygonMethod::kBoundary, ApparentVertices::kFixed);
    const Eigen::Matrix3d& expected = moving.derivatives.hessian.value;
    const double size = expected.cwiseAbs().maxCoeff();
    if (size > moving.bounds.hessian) {
      errors.push_back((fixed.derivatives.hessian.value - expected).cwiseAbs().maxCoeff() / size);
    }
  }
  return errors;
}

ErrorHistogram histogramOf(const std::vector<double>& errors) {
  ErrorHistogram histogram;
  for (const double error : errors) {
    const double decade = error > 0.0 ? std::floor(std::log10(error)) - ErrorHistogram::kFirstDecade : -1.0;
    const double bin = std::clamp(decade + 1.0, 0.0, static_cast<double>(ErrorHistogram::kDecades + 1));
    histogram.shares[static_cast<std::size_t>(bin)] += 1.0 / static_cast<double>(errors.size());
  }
  return histogram;
}

}  // namespace irradiff
