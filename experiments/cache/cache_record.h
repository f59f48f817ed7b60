#pragma once

#include "derivatives/scene/receiver.h"

#include <Eigen/Core>

namespace irradiff {

/// A record of an irradiance cache, Section 4.4 of [Schwarzhaupt et al. 2012]. World coordinates, metres. In flatland
/// all is in the plane z = 0, and the second axis is z.
struct CacheRecord {
  Receiver receiver;
  double irradiance = 0.0;              ///< W/m^2
  Eigen::Vector3d gradient;             ///< translational; W/m^3
  Eigen::Vector3d rotational_gradient;  ///< with respect to a rotation vector: belongs to n_i x n; W/(m^2 rad)
  Eigen::Vector3d first_axis;           ///< unit, tangential
  Eigen::Vector3d second_axis;          ///< unit, tangential, orthogonal to the first
  Eigen::Vector2d half_axes;            ///< of the valid region along both; positive, may be infinite
  /// Of extrapolation to second order, tangential; W/m^4. Zero for the first order of Eq. (15).
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

}  // namespace irradiff
