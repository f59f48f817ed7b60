#pragma once

#include "derivatives/error_metric/record_estimator.h"
#include "derivatives/error_metric/reprojection.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/scene/polygon.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/figures/point_estimator.h"
#include "experiments/ray_casting/ray_caster.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace irradiff {

/// What records of a scene's direct light know from hemisphere samples: irradiance, Ward-Heckbert gradients, the
/// Hessians of RecordEstimator, and the errors that the samples predict by reprojection.
class SampledKnowledge {
 public:
  /// As many concentric strata as `rays` make a square, a jittered ray in each; profiles have `directions`. Requires
  /// validated polygons and at least 4 rays. Throws as ReprojectedErrors.
  SampledKnowledge(std::span<const Polygon> polygons, std::size_t rays, std::uint64_t seed, std::size_t directions);

  struct Gather {
    RecordKnowledge record;
    ReprojectedError reprojection;
  };

  /// Of receiver number `point`, on which its rays depend. May be called from several threads at once. Throws as
  /// estimators do.
  Gather gather(const Receiver& receiver, std::size_t point, std::span<const double> distances) const;

  std::size_t rays() const { return plan_.shape.size(); }

 private:
  struct HessianEstimators {
    std::unique_ptr<RecordEstimator> radiometric, geometric, occlusion;
  };

  RayCaster caster_;
  SamplingPlan plan_;
  Strata strata_;
  std::unique_ptr<Estimator> gradients_;
  std::array<HessianEstimators, kRadianceShares.size()> hessians_;
  ReprojectedErrors reprojection_;
};

}  // namespace irradiff
