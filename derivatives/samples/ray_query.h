#pragma once

#include <Eigen/Core>

#include <functional>

namespace irradiff {

/// What a ray from the receiver sees.
struct RayHit {
  double inverse_distance = 0.0;  ///< 1/m; 0 if the ray hits nothing
  double radiance = 0.0;          ///< W/(m^2 sr)
};

/// Casts one ray from the receiver in a unit direction of the sample frame (t, b, n) that is not below the horizon.
using RayQuery = std::function<RayHit(const Eigen::Vector3d& direction)>;

}  // namespace irradiff
