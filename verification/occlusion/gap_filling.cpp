#include "verification/occlusion/gap_filling.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/visible_region/region_differences.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace irradiff {
namespace {

/// Both Hessians of a scene.
struct Hessians {
  Eigen::Matrix3d fixed;
  Eigen::Matrix3d moving;
  std::size_t apparent_vertices;
};

/// Nothing where the library refuses the receiver.
std::optional<SceneEvaluation<3>> evaluationOf(const SceneEvaluator& evaluator, const Receiver& receiver) {
  try {
    return evaluator.evaluate(receiver);
  } catch (const InvalidScene&) {
    return std::nullopt;
  }
}

/// Of a scene in which something is partly hidden, if the Hessian exists and is not zero.
std::optional<Hessians> hessiansOf(const OccludedScene& scene) {
  const SceneEvaluator evaluator(scene.polygons);
  const std::optional<SceneEvaluation<3>> moving = evaluationOf(evaluator, scene.receiver);
  if (!moving || !moving->has_occlusion || !moving->no_hessian.empty() ||
      moving->derivatives.hessian.value.cwiseAbs().maxCoeff() <= moving->bounds.hessian) {
    return std::nullopt;
  }
  const SceneEvaluation<3> fixed =
      evaluator.evaluate(scene.receiver, evaluator.view(scene.receiver), ApparentVertices::kFixed);
  return Hessians{fixed.derivatives.hessian.value, moving->derivatives.hessian.value, moving->apparent_vertices};
}

double relativeError(const Eigen::Matrix3d& actual, const MultiprecisionMatrix& expected) {
  Multiprecision error = 0;
  Multiprecision size = 0;
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    error = std::max<Multiprecision>(error, abs(Multiprecision(actual(i)) - expected(i)));
    size = std::max<Multiprecision>(size, abs(expected(i)));
  }
  return Multiprecision(error / size).convert_to<double>();
}

}  // namespace

GapFillingErrors gapFillingErrors(const SceneFamily& family, std::size_t count, std::uint64_t seed) {
  GapFillingErrors result;
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<Hessians> hessians = hessiansOf(drawScene(family, seed, i));
    if (!hessians) continue;
    if (hessians->apparent_vertices == 0) {
      ++result.without_vertices;
    } else {
      result.errors.push_back((hessians->fixed - hessians->moving).cwiseAbs().maxCoeff() /
                              hessians->moving.cwiseAbs().maxCoeff());
    }
  }
  return result;
}

std::vector<GapFillingResiduals> gapFillingResiduals(const SceneFamily& family, std::size_t count, std::uint64_t seed) {
  std::vector<GapFillingResiduals> residuals;
  for (std::size_t i = 0; i < count; ++i) {
    const OccludedScene scene = drawScene(family, seed, i);
    const std::optional<Hessians> hessians = hessiansOf(scene);
    if (!hessians) continue;
    const MultiprecisionMatrix expected =
        differentiateRegions(CutScene(scene.polygons), scene.receiver, ldexp(Multiprecision(extentOf(scene)), -150))
            .hessian;
    residuals.push_back({relativeError(hessians->fixed, expected), relativeError(hessians->moving, expected)});
  }
  return residuals;
}

ErrorHistogram histogramOf(const std::vector<double>& errors) {
  ErrorHistogram histogram;
  for (const double error : errors) {
    const double decade = error > 0.0 ? std::floor(std::log10(error)) - ErrorHistogram::kFirstDecade : -1.0;
    const double bin = std::clamp(decade + 1.0, 0.0, static_cast<double>(ErrorHistogram::kDecades + 1));
    ++histogram.counts[static_cast<std::size_t>(bin)];
  }
  return histogram;
}

}  // namespace irradiff
