#pragma once

#include "derivatives/samples/hemisphere_samples.h"

#include <Eigen/Core>

#include <cmath>
#include <optional>

namespace irradiff {

/// Irradiance and its derivatives estimated from hemisphere samples. What an estimator cannot know has no value.
/// Units: W/m^2, W/m^3, W/m^4 for radiance in W/(m^2 sr).
///
/// Vectors and matrices are in the frame (t, b, n) of the samples; the tangential Hessian belongs to (t, b).
struct IrradianceEstimate {
  double irradiance = 0.0;
  std::optional<Eigen::Vector3d> rotational_gradient;  ///< with respect to a rotation vector; RotationalGradient
  /// Translational. Of an estimator that knows the tangent plane only, the component along n is 0 and
  /// `knows_normal_component` false.
  std::optional<Eigen::Vector3d> gradient;
  bool knows_normal_component = false;
  std::optional<Eigen::Matrix3d> hessian;
  std::optional<Eigen::Matrix2d> tangential_hessian;

  /// Every number that has a value.
  bool isFinite() const {
    return std::isfinite(irradiance) && (!rotational_gradient || rotational_gradient->allFinite()) &&
           (!gradient || gradient->allFinite()) && (!hessian || hessian->allFinite()) &&
           (!tangential_hessian || tangential_hessian->allFinite());
  }

  /// Of an estimator that knows all of both derivatives of position.
  void setPositionDerivatives(const Eigen::Vector3d& whole_gradient, const Eigen::Matrix3d& whole_hessian) {
    gradient = whole_gradient;
    knows_normal_component = true;
    hessian = whole_hessian;
    tangential_hessian = whole_hessian.topLeftCorner<2, 2>();
  }
};

}  // namespace irradiff
