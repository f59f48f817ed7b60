#pragma once

#include "derivatives/error_metric/error_ellipse.h"
#include "derivatives/error_metric/valid_region.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// The error of a record's extrapolation at points around it, |E(x + d) - E'(x + d)|, whoever predicts E: the integrand
/// of Eq. (4) of [Schwarzhaupt et al. 2012].
///
/// Points are on rays from the record: direction k of n is at the angle 2 pi k/n from the first tangent, and all have
/// the same distances, ascending. Where there is no receiver (beyond a wall, off the surface) the error is 0: a record
/// is not used there. In flatland there are two directions, along the tangent and against it.
///
/// Along a ray the error is quadratic up to the first distance, linear between distances, and beyond the last it grows
/// with the square of the distance. Between rays it is linear in the angle. docs/derivations/error_metrics.md,
/// section 10.
struct ErrorProfile {
  std::vector<double> distances;  ///< m, positive, ascending
  std::vector<float> errors;      ///< W/m^2; of direction k at distance m: errors[k * distances.size() + m]

  std::size_t directions() const { return distances.empty() ? 0 : errors.size() / distances.size(); }

  /// Throws std::invalid_argument naming the number unless distances are positive, finite and strictly ascending, there
  /// is at least one, errors are finite and not negative and there are as many for each direction.
  void require() const;
};

// Eq. (4): the integral of the error over an ellipse, W. By the trapezoidal rule in the angle, at the profile's
// directions or as many times more as it takes to have 8 b/a, b/a the ellipse's aspect; along a ray exactly. Never
// decreases as the ellipse grows. Throws as `require`. Requires positive, finite half-axes.
double integratedError(const ErrorProfile& profile, const ValidRegion& region);

// The largest ellipse whose error is at most `threshold` (unit and options: errorEllipse; the rule does not matter),
// among those with 8 orientations, pi/8 apart, and with aspects k^(1/3), k^(2/3) and k, k the largest, and the circle.
// Its mean error is kept by each smaller ellipse of this shape too. The first half-axis is the shorter. Half-axes end
// at `largest_radius`, and have at least `smallest_radius` whatever the error. Relative error of the size: 2^-10.
// Infinite half-axes where neither error nor limit ends it. Throws std::invalid_argument as `require`, and naming the
// irradiance if it is not positive, the error relative and the profile not zero. Requires options.require(), a finite
// threshold > 0, 0 <= smallest_radius <= largest_radius.
ValidRegion largestEllipse(const ErrorProfile& profile, Irradiance<double> irradiance, double threshold,
                           const EllipseOptions& options, double smallest_radius, double largest_radius);

// The counterparts in flatland, of a profile of two directions, which throw with any other number: the integral over
// [-half_length, half_length], W; and half the length of the longest interval about the record at `threshold` (unit:
// errorInterval), likewise with limits.
double integratedIntervalError(const ErrorProfile& profile, double half_length);
double largestInterval(const ErrorProfile& profile, Irradiance<double> irradiance, double threshold, ErrorScale scale,
                       ErrorMeasure measure, double smallest_half_length, double largest_half_length);

}  // namespace irradiff
