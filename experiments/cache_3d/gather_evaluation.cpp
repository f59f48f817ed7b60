#include "experiments/cache_3d/gather_evaluation.h"

#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/estimators/geometric.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace irradiff {

namespace {

Eigen::Matrix2d symmetric(const Eigen::Matrix2d& matrix) { return 0.5 * (matrix + matrix.transpose()); }

HemisphereSamples withBrightHits(const HemisphereSamples& samples) {
  HemisphereSamples result = samples;
  std::ranges::transform(samples.inverse_distance, result.radiance.begin(),
                         [](double inverse) { return inverse > 0.0 ? 1.0 : 0.0; });
  return result;
}

/// A derivative of the samples, and of radiance 1 on every hit.
struct Pair {
  Eigen::Matrix2d samples = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d hits = Eigen::Matrix2d::Zero();

  Eigen::Matrix2d with(double radiance) const { return symmetric(samples + radiance * hits); }
};

}  // namespace

GatherEvaluation::GatherEvaluation(GridShape shape, std::size_t directions)
    : strata_(Stratification::kConcentric, shape),
      sums_(Stratification::kConcentric, shape),
      patches_(strata_),
      walls_(makeEstimator("ward-heckbert", Stratification::kConcentric, shape)),
      mesh_(makeEstimator("triangulated", Stratification::kConcentric, shape)),
      errors_(Stratification::kConcentric, shape, directions) {}

RecordKnowledge GatherEvaluation::knowledge(const HemisphereSamples& samples) const {
  const IrradianceEstimate walls = walls_->estimate(samples);
  const Eigen::Matrix3d axes = samples.frame.axes();
  RecordKnowledge known;
  known.irradiance = walls.irradiance;
  known.gradient = axes * *walls.gradient;
  known.rotational_gradient = axes * *walls.rotational_gradient;
  known.harmonic_mean_distance = harmonicMeanDistance(samples, strata_);

  const HemisphereSamples hits = withBrightHits(samples);
  const double irradiance_of_hits = sums_.irradiance(hits);
  const Pair occlusion{*mesh_->estimate(samples).tangential_hessian, *mesh_->estimate(hits).tangential_hessian};
  Pair radiometric;
  Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
  const std::vector<Eigen::Vector3d> planes = patches_.inversePlanes(samples);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Eigen::Matrix2d patch = patches_.derivatives(samples, i, planes[i]).hessian.topLeftCorner<2, 2>();
    radiometric.samples += samples.radiance[i] * patch;
    radiometric.hits += patch;
    curvature += absoluteValue(patch);
  }
  const bool is_black = known.irradiance == 0.0;
  for (std::size_t i = 0; i < kRadianceShares.size(); ++i) {
    const double added = is_black ? 1.0 : kRadianceShares[i] * std::numbers::inv_pi * known.irradiance;
    MetricHessians& hessians = known.hessians[i];
    hessians.irradiance = is_black ? irradiance_of_hits : known.irradiance;
    hessians.occlusion = occlusion.with(added);
    hessians.radiometric = radiometric.with(added);
    hessians.geometric = symmetric((known.irradiance + added * irradiance_of_hits) * std::numbers::inv_pi * curvature);
  }
  return known;
}

ReprojectedError GatherEvaluation::reprojection(const HemisphereSamples& samples,
                                                std::span<const double> distances) const {
  return errors_.predict(samples, distances);
}

}  // namespace irradiff
