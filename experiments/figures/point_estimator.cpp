#include "experiments/figures/point_estimator.h"

#include "derivatives/estimators/discontinuity.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/sample_hemisphere.h"

#include <Eigen/Eigenvalues>

#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace irradiff {

EstimateValues valuesOf(const IrradianceEstimate& estimate) {
  EstimateValues values{};
  values.fill(std::numeric_limits<double>::quiet_NaN());
  values[kEstimateE] = estimate.irradiance;
  if (estimate.gradient) {
    values[kEstimateGradientX] = estimate.gradient->x();
    values[kEstimateGradientY] = estimate.gradient->y();
    if (estimate.knows_normal_component) values[kEstimateGradientZ] = estimate.gradient->z();
  }
  if (estimate.tangential_hessian) {
    const Eigen::Matrix2d& hessian = *estimate.tangential_hessian;
    values[kEstimateHessianXX] = hessian(0, 0);
    values[kEstimateHessianXY] = 0.5 * (hessian(0, 1) + hessian(1, 0));
    values[kEstimateHessianYY] = hessian(1, 1);
  }
  if (estimate.hessian) {
    const Eigen::Matrix3d symmetric = 0.5 * (*estimate.hessian + estimate.hessian->transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric, Eigen::EigenvaluesOnly);
    values[kEstimateLambda1] = solver.eigenvalues()(2);
    values[kEstimateLambda2] = solver.eigenvalues()(1);
    values[kEstimateLambda3] = solver.eigenvalues()(0);
  }
  return values;
}

bool castsItsOwn(std::string_view name) { return name == "discontinuity"; }

PointEstimator pointEstimator(std::string_view name, Stratification stratification, GridShape shape) {
  // A function is copied, its estimator is not.
  const std::shared_ptr<const Estimator> estimator = makeEstimator(name, stratification, shape);
  if (!castsItsOwn(name)) {
    return [estimator](const PointSamples& at) { return estimator->estimate(at.samples); };
  }
  const std::size_t budget = shape.size();
  if (budget < kFewestDiscontinuityRays) {
    throw std::invalid_argument("estimator discontinuity: given " + std::to_string(budget) + " rays, must have " +
                                std::to_string(kFewestDiscontinuityRays) + " at least");
  }
  return [budget](const PointSamples& at) {
    return estimateFromDiscontinuities(at.rays->query(), budget, 2.0 * std::numbers::pi * at.turn).estimate;
  };
}

std::vector<std::string> estimatorsFor(Stratification stratification) {
  // Of the least size that every stratification has.
  const GridShape shape = stratification == Stratification::kHemicube ? GridShape{6, 2} : GridShape{2, 2};
  std::vector<std::string> names;
  for (const EstimatorDescription& description : estimatorDescriptions()) {
    try {
      makeEstimator(description.name, stratification, shape);
    } catch (const std::invalid_argument&) {
      continue;
    }
    names.emplace_back(description.name);
  }
  return names;
}

PointSamples gatherSamples(const ReceiverRays& rays, const SampleFrame& frame, const SamplingPlan& plan,
                           std::uint64_t point) {
  // All directions first: rays are cast many at a time.
  const auto cast_none = [](const Eigen::Vector3d&) { return RayHit{}; };
  PointSamples at{
      sampleHemisphere(Strata(plan.stratification, plan.shape), plan.pattern, plan.seed, point, frame, cast_none),
      &rays};
  rays.cast(at.samples);
  // A sample that no hemisphere has.
  constexpr std::uint64_t kTurn = 0xffffffff;
  at.turn = stratumOffset(SamplePattern::kJittered, plan.seed, point, kTurn).along_row;
  return at;
}

}  // namespace irradiff
