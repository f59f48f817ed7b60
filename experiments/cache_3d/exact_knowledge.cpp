#include "experiments/cache_3d/exact_knowledge.h"

#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "derivatives/scene/invalid_scene.h"
#include "experiments/cache_3d/static_pieces.h"

#include <numbers>

namespace irradiff {
namespace {

constexpr Stratification kStratification = Stratification::kConcentric;
constexpr GridShape kShape{32, 32};
static_assert(kShape.rows * kShape.columns == kExactKnowledgeRays);

std::vector<Polygon> withRadiance1(std::span<const Polygon> polygons) {
  std::vector<Polygon> bright(polygons.begin(), polygons.end());
  for (Polygon& polygon : bright) polygon.radiance = 1.0;
  return bright;
}

bool hasAll(const SceneEvaluation<3>& evaluation) {
  return evaluation.no_gradient.empty() && evaluation.no_tangential_hessian.empty();
}

/// Through the middles of strata, with radiance 1 wherever something is hit.
HemisphereSamples brightSamples(const RayCaster& caster, const Receiver& receiver) {
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(receiver.normal);
  const SampleFrame frame{receiver.position, tangents.col(0), tangents.col(1), receiver.normal};
  const auto cast_none = [](const Eigen::Vector3d&) { return RayHit{}; };
  HemisphereSamples samples =
      sampleHemisphere(Strata(kStratification, kShape), SamplePattern::kCentred, 0, 0, frame, cast_none);
  caster.from(frame).cast(samples);
  for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
    samples.radiance[i] = samples.inverse_distance[i] > 0.0 ? 1.0 : 0.0;
  }
  return samples;
}

}  // namespace

ExactKnowledge::ExactKnowledge(std::span<const Polygon> polygons)
    : evaluator_(polygons),
      bright_(withRadiance1(polygons)),
      caster_(polygons),
      geometric_(makeEstimator("geometric", kStratification, kShape)) {
  for (const Polygon& polygon : polygons) radiances_.push_back(polygon.radiance);
}

SceneEvaluation<3> ExactKnowledge::derivativesAt(const SceneEvaluator& evaluator, const Receiver& receiver,
                                                 double beside) const {
  const SceneEvaluation<3> evaluation = evaluator.evaluate(receiver);
  if (hasAll(evaluation)) return evaluation;
  // Along no line that a scene is likely to have.
  const Eigen::Vector3d aside =
      tangentFrame<double>(receiver.normal) * Eigen::Vector2d(0.8235, 0.5673).normalized() * beside;
  const SceneEvaluation<3> other = evaluator.evaluate({receiver.position + aside, receiver.normal});
  if (hasAll(other)) return other;
  throw InvalidScene(describeReceiver(receiver) + ": " +
                     (evaluation.no_gradient.empty() ? evaluation.no_tangential_hessian : evaluation.no_gradient));
}

PointTruth ExactKnowledge::truth(const Receiver& receiver, double beside) const {
  const SceneEvaluation<3> evaluation = derivativesAt(evaluator_, receiver, beside);
  return {evaluation.derivatives.irradiance.value, evaluation.bounds.irradiance, evaluation.derivatives.gradient.value};
}

std::vector<bool> ExactKnowledge::seenPolygons(const Receiver& receiver) const {
  return evaluator_.view(receiver).is_seen;
}

RecordKnowledge ExactKnowledge::record(const Receiver& receiver, double beside) const {
  const IrradianceDerivatives<double> own = derivativesAt(evaluator_, receiver, beside).derivatives;
  const IrradianceDerivatives<double> bright = derivativesAt(bright_, receiver, beside).derivatives;
  const VisibleBoundary view = evaluator_.view(receiver);
  const std::vector<double> ones(radiances_.size(), 1.0);
  const Eigen::Matrix2d static_own = staticPiecesHessian(evaluator_.mesh(), view, radiances_, receiver).value;
  const Eigen::Matrix2d static_bright = staticPiecesHessian(evaluator_.mesh(), view, ones, receiver).value;

  const HemisphereSamples samples = brightSamples(caster_, receiver);
  const IrradianceEstimate geometric = geometric_->estimate(samples);
  // Of mean radiance 1.
  const Eigen::Matrix2d curvature =
      geometric.irradiance > 0.0
          ? Eigen::Matrix2d(std::numbers::pi / geometric.irradiance * *geometric.tangential_hessian)
          : Eigen::Matrix2d(Eigen::Matrix2d::Zero());

  RecordKnowledge known;
  known.irradiance = own.irradiance.value;
  known.gradient = own.gradient.value;
  known.rotational_gradient = own.rotational_gradient.value;
  known.harmonic_mean_distance = harmonicMeanDistance(samples, Strata(kStratification, kShape));
  const bool black = known.irradiance == 0.0;
  for (std::size_t i = 0; i < kRadianceShares.size(); ++i) {
    const double added = black ? 1.0 : kRadianceShares[i] * std::numbers::inv_pi * known.irradiance;
    const double irradiance = known.irradiance + added * bright.irradiance.value;
    known.hessians[i] = {black ? irradiance : known.irradiance, static_own + added * static_bright,
                         irradiance * std::numbers::inv_pi * curvature,
                         own.tangential_hessian.value + added * bright.tangential_hessian.value};
  }
  return known;
}

}  // namespace irradiff
