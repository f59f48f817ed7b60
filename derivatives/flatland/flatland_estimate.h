#pragma once

#include "derivatives/flatland/flatland_samples.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string_view>

namespace irradiff {

/// Flatland irradiance and its derivatives estimated from samples. What an estimator cannot know has no value. Units:
/// W/m, W/m^2, W/m^3 for radiance in W/(m rad). Vectors and matrices are in the frame (t, n) of the samples.
struct FlatlandEstimate {
  double irradiance = 0.0;
  double rotational_gradient = 0.0;  ///< counterclockwise turns positive; W/(m rad)
  /// Translational. Of an estimator that knows the tangent only, the component along n is 0 and
  /// `knows_normal_component` false.
  std::optional<Eigen::Vector2d> gradient;
  bool knows_normal_component = false;
  std::optional<Eigen::Matrix2d> hessian;
  std::optional<double> tangential_hessian;  ///< along t
};

/// Throws std::overflow_error, naming the estimator, the nearest and the brightest of the hits, if a number of the
/// estimate is beyond the range of double. Requires a hit.
void requireFinite(std::string_view name, const FlatlandEstimate& estimate, std::span<const FlatlandHit> hits);

}  // namespace irradiff
