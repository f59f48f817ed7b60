#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/stratification.h"

#include <Eigen/Core>

#include <vector>

namespace irradiff {

/// Irradiance and its rotational gradient as sums over strata of one stratification and shape: what every estimator
/// reports beside its own translational derivatives. Copies may be used from several threads at once.
class StrataSums {
 public:
  /// Throws as Strata does.
  StrataSums(Stratification stratification, GridShape shape);

  // E = sum L P, P the stratum's projected solid angle: pi/N sum L where all are equal, Eq. (3) of [Schwarzhaupt et al.
  // 2012]. W/m^2. Requires samples of the stratification and shape that the sums were made for.
  double irradiance(const HemisphereSamples& samples) const;

  // g = integral of L (n x w) dw ~ sum L (n x w) Omega, w the sample's direction and Omega the stratum's solid angle;
  // in the frame (t, b, n); belongs to Delta = n x n_2, derivatives/boundary/irradiance.h. W/(m^2 rad).
  // The estimate that goes with cosine-weighted samples, pi/N sum L (n x w)/(n.w), is not bounded at the horizon: its
  // variance diverges there as the integral of 1/(n.w). The solid angle of a stratum is finite, and so is each term.
  // Requires samples of the stratification and shape that the sums were made for.
  Eigen::Vector3d rotationalGradient(const HemisphereSamples& samples) const;

 private:
  std::vector<double> projected_solid_angles_;
  std::vector<double> solid_angles_;
};

}  // namespace irradiff
