#pragma once

#include "derivatives/estimators/irradiance_estimate.h"
#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/sample_pattern.h"
#include "derivatives/samples/strata.h"
#include "experiments/ray_casting/ray_caster.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// What an estimator says of one receiver, in the frame of its samples. NaN is what it cannot know.
enum EstimateValue : std::size_t {
  kEstimateE,
  kEstimateGradientX,
  kEstimateGradientY,
  kEstimateGradientZ,
  kEstimateHessianXX,  ///< tangential
  kEstimateHessianXY,
  kEstimateHessianYY,
  kEstimateLambda1,  ///< eigenvalues of the Hessian in space, the largest first
  kEstimateLambda2,
  kEstimateLambda3,
  kEstimateValueCount
};
using EstimateValues = std::array<double, kEstimateValueCount>;

EstimateValues valuesOf(const IrradianceEstimate& estimate);

/// What estimates at a receiver are made of.
struct PointSamples {
  HemisphereSamples samples;
  const ReceiverRays* rays;  ///< of the receiver
  double turn = 0.0;         ///< random, in [0, 1), for what is turned about the normal
};

/// An estimator as figures use it. May be called from several threads.
using PointEstimator = std::function<IrradianceEstimate(const PointSamples&)>;

/// An estimator by its name (estimatorDescriptions()): of the samples, but for `discontinuity`, which is given no
/// samples and spends as many rays of its own (estimateFromDiscontinuities()). Throws as makeEstimator does, and
/// std::invalid_argument naming the rays if `discontinuity` has fewer than kFewestDiscontinuityRays.
PointEstimator pointEstimator(std::string_view name, Stratification stratification, GridShape shape);

/// Whether pointEstimator() of this name spends rays of its own.
bool castsItsOwn(std::string_view name);

/// The names of those that take samples of a stratification, in the order of tables.
std::vector<std::string> estimatorsFor(Stratification stratification);

/// Which rays estimates are made of.
struct SamplingPlan {
  Stratification stratification = Stratification::kConcentric;
  GridShape shape;
  SamplePattern pattern = SamplePattern::kJittered;
  std::uint64_t seed = 0;
};

/// The samples of receiver number `point`. The rays must be those of the frame, and outlive the result.
PointSamples gatherSamples(const ReceiverRays& rays, const SampleFrame& frame, const SamplingPlan& plan,
                           std::uint64_t point);

}  // namespace irradiff
