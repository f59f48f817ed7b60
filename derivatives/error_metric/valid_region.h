#pragma once

#include "derivatives/boundary/irradiance.h"

#include <Eigen/Core>

namespace irradiff {

/// Where in its tangent plane a cache record may be used: an ellipse about the record. Section 4.2 of [Schwarzhaupt et
/// al. 2012].
struct ValidRegion {
  Eigen::Vector2d half_axes;  ///< along the columns of `axes`; m, may be infinite
  Eigen::Matrix2d axes;       ///< columns orthonormal, right-handed, in the frame of `tangentFrame(normal)`
};

// What extrapolation to first order is predicted to be wrong by, integrated over the region: Eq. (5),
//   1/2 integral of |d^T H d| dd,
// in closed form for a Hessian of any signs and an ellipse that need not have its axes (docs/derivations/
// error_metrics.md, section 2). With B the matrix that takes the unit disk to the ellipse and m +- r, r >= 0, the
// eigenvalues of B^T H B, it is det B times
//   pi/4 |m|                                if |m| >= r
//   1/2 (m asin(m/r) + sqrt(r^2 - m^2))     otherwise
// W: an irradiance times an area. Error: 16 u |l1| b^2 det B, l1 the larger eigenvalue of H and b the longer half-axis.
// Requires a finite Hessian whose entries off the diagonal are equal, and finite half-axes.
double integratedError(const TangentialHessian<double>& hessian, const ValidRegion& region);

// The same with |l1| and |l2| in place of the eigenvalues l1, l2 of the Hessian: Eq. (6), a bound of the above and
// equal to it unless the eigenvalues have opposite signs. Of an ellipse in the Hessian's axes it is at most pi/2 times
// as large, where |l1| a^2 = |l2| b^2. pi/8 det B times the trace of B^T |H| B. Unit, error, requirements as above.
double integratedErrorBound(const TangentialHessian<double>& hessian, const ValidRegion& region);

}  // namespace irradiff
