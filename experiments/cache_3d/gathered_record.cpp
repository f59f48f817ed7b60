#include "experiments/cache_3d/gathered_record.h"

#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/estimators/geometric.h"

#include <algorithm>
#include <numbers>
#include <string_view>
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

class NumberWriter {
 public:
  explicit NumberWriter(double* numbers) : next_(numbers) {}
  void operator()(double& value) { *next_++ = value; }

 private:
  double* next_;
};

class NumberReader {
 public:
  explicit NumberReader(const double* numbers) : next_(numbers) {}
  void operator()(double& value) { value = *next_++; }

 private:
  const double* next_;
};

/// Every number of a record once, in one order.
template <class Visit>
void visitNumbers(GatheredRecord& record, Visit visit) {
  visit(record.irradiance);
  visit(record.irradiance_of_hits);
  for (Eigen::Index i = 0; i < 2; ++i) visit(record.gradient[i]);
  for (Eigen::Index i = 0; i < 2; ++i) visit(record.rotational_gradient[i]);
  visit(record.harmonic_mean_distance);
  for (Eigen::Matrix2d* hessian : {&record.radiometric, &record.radiometric_of_hits, &record.geometric,
                                   &record.occlusion, &record.occlusion_of_hits}) {
    visit((*hessian)(0, 0));
    visit((*hessian)(0, 1));
    visit((*hessian)(1, 1));
    (*hessian)(1, 0) = (*hessian)(0, 1);
  }
}

}  // namespace

std::array<double, kGatheredNumbers> numbersOf(const GatheredRecord& record) {
  std::array<double, kGatheredNumbers> numbers{};
  GatheredRecord copy = record;
  visitNumbers(copy, NumberWriter(numbers.data()));
  return numbers;
}

GatheredRecord gatheredRecord(const double* numbers) {
  GatheredRecord record;
  visitNumbers(record, NumberReader(numbers));
  return record;
}

RecordDerivatives GatheredRecord::derivatives(const ErrorMetricDescription& metric, double radiance_share) const {
  RecordDerivatives result;
  result.irradiance = {irradiance};
  if (metric.takes_distance) result.harmonic_mean_distance = harmonic_mean_distance;
  if (metric.takes_gradient) result.tangential_gradient = gradient;
  if (!metric.takes_hessian) return result;
  const bool is_black = irradiance == 0.0;
  const double added = is_black ? 1.0 : radiance_share * std::numbers::inv_pi * irradiance;
  if (is_black) result.irradiance = {irradiance_of_hits};
  const std::string_view name = metric.name;
  if (name == "radiometric-hessian") {
    result.tangential_hessian = {radiometric + added * radiometric_of_hits};
  } else if (name == "geometric-hessian") {
    result.tangential_hessian = {(irradiance + added * irradiance_of_hits) * std::numbers::inv_pi * geometric};
  } else {
    result.tangential_hessian = {occlusion + added * occlusion_of_hits};
  }
  return result;
}

GatherEvaluation::GatherEvaluation(GridShape shape)
    : strata_(Stratification::kConcentric, shape),
      sums_(Stratification::kConcentric, shape),
      patches_(strata_),
      walls_(makeEstimator("ward-heckbert", Stratification::kConcentric, shape)),
      mesh_(makeEstimator("triangulated", Stratification::kConcentric, shape)) {}

GatheredRecord GatherEvaluation::record(const HemisphereSamples& samples) const {
  GatheredRecord record;
  const IrradianceEstimate walls = walls_->estimate(samples);
  record.irradiance = walls.irradiance;
  record.gradient = walls.gradient->head<2>();
  record.rotational_gradient = walls.rotational_gradient->head<2>();
  record.harmonic_mean_distance = harmonicMeanDistance(samples, strata_);

  const HemisphereSamples hits = withBrightHits(samples);
  record.irradiance_of_hits = sums_.irradiance(hits);
  record.occlusion = symmetric(*mesh_->estimate(samples).tangential_hessian);
  record.occlusion_of_hits = symmetric(*mesh_->estimate(hits).tangential_hessian);

  record.radiometric.setZero();
  record.radiometric_of_hits.setZero();
  record.geometric.setZero();
  const std::vector<Eigen::Vector3d> planes = patches_.inversePlanes(samples);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Eigen::Matrix2d patch = patches_.derivatives(samples, i, planes[i]).hessian.topLeftCorner<2, 2>();
    record.radiometric += samples.radiance[i] * patch;
    record.radiometric_of_hits += patch;
    record.geometric += absoluteValue(patch);
  }
  record.radiometric = symmetric(record.radiometric);
  record.radiometric_of_hits = symmetric(record.radiometric_of_hits);
  record.geometric = symmetric(record.geometric);
  return record;
}

}  // namespace irradiff
