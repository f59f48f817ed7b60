#pragma once

#include "derivatives/error_metric/reprojection.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/estimators/strata_sums.h"
#include "derivatives/estimators/surface_patches.h"
#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"
#include "experiments/cache_3d/metric_records.h"

#include <cstddef>
#include <memory>
#include <span>

namespace irradiff {

/// What records know from concentric samples of one shape, as SampledKnowledge has it, in a third of the time: the
/// Hessians are linear in the radiance of the hits, so those with any share of the mean radiance added are a sum of
/// those of the samples and of those with radiance 1 on every hit, and the patches of radiometric and geometric
/// Hessian are the same. May be used from several threads at once.
class GatherEvaluation {
 public:
  /// Profiles have `directions`. Throws as ReprojectedErrors.
  GatherEvaluation(GridShape shape, std::size_t directions);

  /// Equal to what RecordEstimator and the estimators by their names say, to rounding. Requires samples in the frame of
  /// `tangentFrame(normal)`.
  RecordKnowledge knowledge(const HemisphereSamples& samples) const;

  /// The error that the samples predict.
  ReprojectedError reprojection(const HemisphereSamples& samples, std::span<const double> distances) const;

 private:
  Strata strata_;
  StrataSums sums_;
  SurfacePatches patches_;
  std::unique_ptr<Estimator> walls_;
  std::unique_ptr<Estimator> mesh_;
  ReprojectedErrors errors_;
};

}  // namespace irradiff
