#pragma once

#include "derivatives/error_metric/error_metric.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/estimators/strata_sums.h"
#include "derivatives/estimators/surface_patches.h"
#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>

namespace irradiff {

/// What all error metrics need of one gather, in the frame (t, b, n) of its samples. Hessians are tangential, W/m^4.
///
/// Derivatives are linear in the radiance of the hits: those with any share of the mean radiance added are a sum of
/// those of the samples and of those with radiance 1 on every hit, of which the fields named `of_hits` are.
struct GatheredRecord {
  double irradiance = 0.0;              ///< W/m^2
  double irradiance_of_hits = 0.0;      ///< for radiance 1; pi where every ray hits
  Eigen::Vector2d gradient;             ///< tangential, from the walls between strata; W/m^3
  Eigen::Vector2d rotational_gradient;  ///< the component along n is 0; W/(m^2 rad)
  double harmonic_mean_distance = 0.0;  ///< m
  Eigen::Matrix2d radiometric;
  Eigen::Matrix2d radiometric_of_hits;
  Eigen::Matrix2d geometric;  ///< for mean radiance 1: that of the samples is E/pi times it
  Eigen::Matrix2d occlusion;
  Eigen::Matrix2d occlusion_of_hits;

  /// What a metric takes of a record, the radiance share of RecordEstimator added to every hit; where the gather is
  /// black, radiance 1. Equals RecordEstimator::estimate to rounding.
  RecordDerivatives derivatives(const ErrorMetricDescription& metric, double radiance_share) const;
};

/// A record as numbers for a TileStore, and back.
inline constexpr std::size_t kGatheredNumbers = 22;
std::array<double, kGatheredNumbers> numbersOf(const GatheredRecord& record);
GatheredRecord gatheredRecord(const double* numbers);

/// Makes gathered records of concentric samples of one shape. May be used from several threads at once.
class GatherEvaluation {
 public:
  explicit GatherEvaluation(GridShape shape);

  GatheredRecord record(const HemisphereSamples& samples) const;

 private:
  Strata strata_;
  StrataSums sums_;
  SurfacePatches patches_;
  std::unique_ptr<Estimator> walls_;
  std::unique_ptr<Estimator> mesh_;
};

}  // namespace irradiff
