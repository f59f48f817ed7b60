#pragma once

#include "derivatives/error_metric/error_profile.h"
#include "derivatives/error_metric/valid_region.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

namespace irradiff {

/// Irradiance at a step in the tangent plane from a receiver, in the frame of tangentFrame(normal); W/m^2. Nothing
/// where there is no receiver.
using IrradianceAround = std::function<std::optional<double>(const Eigen::Vector2d& step)>;

/// E + g.d + d^T H d/2.
struct QuadraticIrradiance {
  double irradiance = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();

  double at(const Eigen::Vector2d& step) const {
    return irradiance + gradient.dot(step) + 0.5 * step.dot(hessian * step);
  }
};

// The errors of an extrapolation. Requires distances that are positive, finite and ascending.
ErrorProfile errorsOf(const QuadraticIrradiance& extrapolation, const IrradianceAround& irradiance,
                      std::span<const double> distances, std::size_t directions);

// The quadratic with the same irradiance at the record that is nearest to `irradiance` over the region, by weighted
// least squares: weights are those of interpolation, 1 at the record and 0 on the border (Eqs. (16) to (18) of
// [Schwarzhaupt et al. 2012]). In place of derivatives at one point, which know nothing of a penumbra that begins a
// step away. `start` where there are too few receivers around to tell. Requires finite half-axes.
QuadraticIrradiance nearestQuadratic(const QuadraticIrradiance& start, const IrradianceAround& irradiance,
                                     const ValidRegion& region);

}  // namespace irradiff
