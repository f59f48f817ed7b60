#pragma once

#include "derivatives/error_metric/error_metric.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/estimators/strata_sums.h"
#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"

#include <memory>
#include <string_view>

namespace irradiff {

/// What a metric takes of a record, from hemisphere samples, with the two amendments of section 4.2 of [Schwarzhaupt et
/// al. 2012] that keep a Hessian away from zero in the dark:
///
/// - the Hessian is that of the samples with a share (the paper: 1 %) of the mean radiance E/pi added to every hit;
/// - if E is 0 it is that of radiance 1 on every hit, and the irradiance that goes with it is that of this radiance,
/// not
///   0, with which Eq. (14) would give radii of 0. Multiply neither into a cache: they are the metric's alone.
///
/// Where an estimator gives nothing for constant radiance, as it should in a closed room, neither helps
/// (docs/derivations/error_metrics.md, section 7): the Hessian of a black record is then zero and its region infinite.
class RecordEstimator {
 public:
  /// For the `metric`'s own estimator. Throws as makeEstimator, and std::invalid_argument naming the share unless it is
  /// finite and at least 0.
  RecordEstimator(const ErrorMetricDescription& metric, Stratification stratification, GridShape shape,
                  double radiance_share = 0.01);

  /// With another estimator of the Hessian or gradient, by its name. Throws also if the metric takes neither.
  RecordEstimator(const ErrorMetricDescription& metric, std::string_view estimator, Stratification stratification,
                  GridShape shape, double radiance_share = 0.01);

  /// In the frame (t, b) of the samples. What the estimator does not know has no value. May be called from several
  /// threads at once. Throws as Estimator::estimate.
  RecordDerivatives estimate(const HemisphereSamples& samples) const;

 private:
  bool takes_distance_;
  bool takes_hessian_;
  double radiance_share_;
  Strata strata_;
  StrataSums sums_;
  std::unique_ptr<Estimator> estimator_;  ///< null: only the distance is taken
};

}  // namespace irradiff
