#include "derivatives/error_metric/record_estimator.h"

#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/scene/number_text.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

/// `radiance` more on every hit. What is seen through a miss has no surface and stays.
HemisphereSamples withHitsBrighter(const HemisphereSamples& samples, double radiance) {
  HemisphereSamples result = samples;
  for (std::size_t i = 0; i < result.radiance.size(); ++i) {
    if (result.inverse_distance[i] > 0.0) result.radiance[i] += radiance;
  }
  return result;
}

}  // namespace

RecordEstimator::RecordEstimator(const ErrorMetricDescription& metric, Stratification stratification, GridShape shape,
                                 double radiance_share)
    : RecordEstimator(metric, metric.estimator, stratification, shape, radiance_share) {}

RecordEstimator::RecordEstimator(const ErrorMetricDescription& metric, std::string_view estimator,
                                 Stratification stratification, GridShape shape, double radiance_share)
    : takes_distance_(metric.takes_distance),
      takes_hessian_(metric.takes_hessian),
      radiance_share_(radiance_share),
      strata_(stratification, shape),
      sums_(stratification, shape) {
  if (!(radiance_share >= 0.0) || std::isinf(radiance_share)) {
    throw std::invalid_argument("the share of the mean radiance that is added for an error metric is " +
                                numberText(radiance_share) + ", must be finite and >= 0");
  }
  const bool takes_derivatives = metric.takes_gradient || metric.takes_hessian;
  if (!takes_derivatives && !estimator.empty()) {
    throw std::invalid_argument("error metric " + std::string(metric.name) +
                                ": takes no derivatives, given estimator " + std::string(estimator));
  }
  if (takes_derivatives) estimator_ = makeEstimator(estimator, stratification, shape);
}

RecordDerivatives RecordEstimator::estimate(const HemisphereSamples& samples) const {
  RecordDerivatives record;
  record.irradiance = {sums_.irradiance(samples)};
  if (takes_distance_) record.harmonic_mean_distance = harmonicMeanDistance(samples, strata_);
  if (!estimator_) return record;

  if (!takes_hessian_) {
    const IrradianceEstimate estimate = estimator_->estimate(samples);
    if (estimate.gradient) record.tangential_gradient = estimate.gradient->head<2>();
    return record;
  }
  const bool black = record.irradiance.value == 0.0;
  const double added = black ? 1.0 : radiance_share_ * std::numbers::inv_pi * record.irradiance.value;
  const IrradianceEstimate estimate = estimator_->estimate(withHitsBrighter(samples, added));
  if (estimate.tangential_hessian) record.tangential_hessian = {*estimate.tangential_hessian};
  if (black) record.irradiance = {estimate.irradiance};
  return record;
}

}  // namespace irradiff
