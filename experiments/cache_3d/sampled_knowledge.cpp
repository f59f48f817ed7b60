#include "experiments/cache_3d/sampled_knowledge.h"

#include "derivatives/boundary/irradiance.h"
#include "derivatives/error_metric/error_metric.h"
#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "experiments/figures/convergence.h"

#include <algorithm>
#include <string_view>

namespace irradiff {
namespace {

SamplingPlan planOf(std::size_t rays, std::uint64_t seed) {
  SamplingPlan plan;
  plan.shape = shapeForRays(plan.stratification, rays);
  plan.seed = seed;
  return plan;
}

std::unique_ptr<RecordEstimator> estimatorOf(std::string_view metric, const SamplingPlan& plan, double share) {
  const auto description =
      std::ranges::find(errorMetricDescriptions(), metric, [](const ErrorMetricDescription& d) { return d.name; });
  return std::make_unique<RecordEstimator>(*description, plan.stratification, plan.shape, share);
}

}  // namespace

SampledKnowledge::SampledKnowledge(std::span<const Polygon> polygons, std::size_t rays, std::uint64_t seed,
                                   std::size_t directions)
    : caster_(polygons),
      plan_(planOf(rays, seed)),
      strata_(plan_.stratification, plan_.shape),
      gradients_(makeEstimator("ward-heckbert", plan_.stratification, plan_.shape)),
      reprojection_(plan_.stratification, plan_.shape, directions) {
  for (std::size_t i = 0; i < kRadianceShares.size(); ++i) {
    hessians_[i].radiometric = estimatorOf("radiometric-hessian", plan_, kRadianceShares[i]);
    hessians_[i].geometric = estimatorOf("geometric-hessian", plan_, kRadianceShares[i]);
    hessians_[i].occlusion = estimatorOf("occlusion-hessian", plan_, kRadianceShares[i]);
  }
}

SampledKnowledge::Gather SampledKnowledge::gather(const Receiver& receiver, std::size_t point,
                                                  std::span<const double> distances) const {
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(receiver.normal);
  const SampleFrame frame{receiver.position, tangents.col(0), tangents.col(1), receiver.normal};
  const ReceiverRays rays = caster_.from(frame);
  const HemisphereSamples samples = gatherSamples(rays, frame, plan_, point).samples;
  const IrradianceEstimate estimate = gradients_->estimate(samples);

  Gather result;
  RecordKnowledge& known = result.record;
  known.irradiance = estimate.irradiance;
  known.gradient = frame.axes() * *estimate.gradient;
  known.rotational_gradient = frame.axes() * *estimate.rotational_gradient;
  known.harmonic_mean_distance = harmonicMeanDistance(samples, strata_);
  for (std::size_t i = 0; i < hessians_.size(); ++i) {
    MetricHessians& hessians = known.hessians[i];
    const RecordDerivatives occlusion = hessians_[i].occlusion->estimate(samples);
    hessians.irradiance = occlusion.irradiance.value;
    hessians.occlusion = occlusion.tangential_hessian->value;
    hessians.radiometric = hessians_[i].radiometric->estimate(samples).tangential_hessian->value;
    hessians.geometric = hessians_[i].geometric->estimate(samples).tangential_hessian->value;
  }
  result.reprojection = reprojection_.predict(samples, distances);
  return result;
}

}  // namespace irradiff
