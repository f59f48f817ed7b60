#include "verification/certified/certified_scene.h"

#include "derivatives/form_factor/prepared_polygon.h"
#include "derivatives/scene/exact_sum.h"
#include "derivatives/scene/invalid_scene.h"
#include "verification/certified/certified_sources.h"
#include "verification/certified/ladder.h"
#include "verification/certified/rounded_evaluation.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace irradiff {

namespace {

/// How many apparent vertices' motion changes the Hessian.
std::size_t movingApparentVertices(const SceneComposition& scene) {
  const auto radiance = [&scene](std::size_t polygon) { return polygon == kNone ? 0.0 : scene.partly_hidden[polygon]; };
  const auto moves = [&radiance](const ApparentVertex& vertex) {
    ExactSum<double, 4> change;
    change.add(radiance(vertex.before.right));
    change.add(-radiance(vertex.before.left));
    change.add(radiance(vertex.after.left));
    change.add(-radiance(vertex.after.right));
    return change.sign() != 0;
  };
  return static_cast<std::size_t>(std::ranges::count_if(scene.view.apparent_vertices, moves));
}

/// A quantity that does not exist has no number.
void clearMissing(SceneEvaluation<3>& evaluation) {
  if (!evaluation.no_gradient.empty()) {
    evaluation.derivatives.gradient.value.setZero();
    evaluation.bounds.gradient = 0.0;
  }
  if (!evaluation.no_hessian.empty()) {
    evaluation.derivatives.hessian.value.setZero();
    evaluation.bounds.hessian = 0.0;
  }
  if (!evaluation.no_tangential_hessian.empty()) {
    evaluation.derivatives.tangential_hessian.value.setZero();
    evaluation.bounds.tangential_hessian = 0.0;
  }
}

bool isBounded(const DerivativeBounds& bounds) {
  return std::isfinite(bounds.irradiance) && std::isfinite(bounds.gradient) && std::isfinite(bounds.hessian) &&
         std::isfinite(bounds.tangential_hessian) && std::isfinite(bounds.rotational_gradient);
}

}  // namespace

template <int Dimension>
Rung CertifiedScene<Dimension>::rung() const {
  Rung highest = Rung::kDouble;
  for (const Rung rung : kRungs) {
    if (sources[static_cast<std::size_t>(rung)] > 0) highest = rung;
  }
  return highest;
}

CertifiedScene<3> certifyScene(const SceneEvaluator& evaluator, const Receiver& receiver, double tolerance) {
  requireTolerance(tolerance);
  const SceneComposition scene = evaluator.compose(receiver);
  CertifiedScene<3> result;
  result.evaluation = scene.dark;
  std::vector<PreparedPolygon> prepared;
  prepared.reserve(scene.whole.size());
  std::vector<LadderSource<3>> sources;
  for (const std::size_t i : scene.whole) {
    const Polygon& polygon = evaluator.polygons()[i];
    prepared.push_back(preparePolygon(polygon, i, receiver));
    sources.push_back({polygon.radiance,
                       [&receiver, &source = prepared.back()](const LadderStep& step) {
                         return polygonValue(source, receiver, step);
                       },
                       {},
                       {}});
  }
  if (scene.firstPartlyHidden()) {
    sources.push_back(
        {1.0, [&](const LadderStep& step) { return viewValue(evaluator.mesh(), scene, receiver, step); }, {}, {}});
    result.evaluation.apparent_vertices = movingApparentVertices(scene);
  }
  const WantedQuantities wanted{result.evaluation.no_gradient.empty(), result.evaluation.no_hessian.empty(),
                                result.evaluation.no_tangential_hessian.empty()};
  const CertifiedValue<3> sum = climb(sources, tolerance, wanted);
  for (const LadderSource<3>& source : sources) ++result.sources[static_cast<std::size_t>(source.step.rung)];
  result.enclosure = sum.enclosure;
  result.misses_tolerance = !meets(sum, tolerance, wanted);
  roundTo(sum, result.evaluation.derivatives, result.evaluation.bounds);
  clearMissing(result.evaluation);
  if (isFinite(result.evaluation.derivatives) && !isBounded(result.evaluation.bounds)) {
    throw InvalidScene("what " + describeReceiver(receiver) + " sees is not told by " + std::to_string(kMostBits) +
                       " bits");
  }
  requireFinite(result.evaluation, receiver, [] { return std::string("what is seen"); });
  return result;
}

template struct CertifiedScene<3>;

}  // namespace irradiff
