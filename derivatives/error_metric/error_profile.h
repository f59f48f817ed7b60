#pragma once

#include "derivatives/error_metric/error_ellipse.h"
#include "derivatives/error_metric/valid_region.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// The error of a record's extrapolation at points around it, |E(x + d) - E'(x + d)|, whoever predicts E: the integrand
/// of Eq. (4) of [Schwarzhaupt et al. 2012].
///
/// Points are on rays from the record: direction k of n is at the angle 2 pi k/n from the first tangent, and all have
/// the same distances, ascending. Where there is no receiver (beyond a wall, off the surface) the error is 0: a record
/// is not used there.
struct ErrorProfile {
  std::vector<double> distances;  ///< m, positive, ascending
  std::vector<float> errors;      ///< W/m^2; of direction k at distance m: errors[k * distances.size() + m]

  std::size_t directions() const { return distances.empty() ? 0 : errors.size() / distances.size(); }
};

// Eq. (4): the integral of the error over an ellipse. Along a ray the error is quadratic up to the first distance and
// then linear between distances; beyond the last it grows with the square of the distance. W. Requires finite
// half-axes.
double integratedError(const ErrorProfile& profile, const ValidRegion& region);

// The largest ellipse whose integrated error (or mean error) is at most `threshold`, of irradiance or of the share of
// the record's own as options.scale says; found among ellipses of 8 orientations and of aspects up to
// options.largest_aspect. The half-axes are at most `largest_radius`, and at least `smallest_radius`.
// options.rule does not matter.
ValidRegion largestEllipse(const ErrorProfile& profile, Irradiance<double> irradiance, double threshold,
                           const EllipseOptions& options, double smallest_radius, double largest_radius);

}  // namespace irradiff
