#pragma once

#include "derivatives/boundary/horizon_clip.h"
#include "derivatives/boundary/small_source.h"

#include <optional>

namespace irradiff {

/// Irradiance of a polygon of radiance 1 and its derivatives, with the sizes that rounding errors are proportional to.
struct AreaRuleSums {
  SmallSourceSums<3> sums;
  double nodes;       ///< number of terms in the sums
  double truncation;  ///< bound of the quadrature error, relative to the sizes
};

// The area rule: the defining integral over a polygon that is small compared with its distance, and its kernel's
// derivatives under the integral sign,
//   E = int (n.p)(N.p)/|p|^4 dA,
// by tensor Gauss-Legendre quadrature on the triangles of a fan. A sum over edges loses distance/size to cancellation;
// here nothing cancels. Where the polygon is cut at the horizon, the cut moves with the receiver, and the Hessian has
// in addition minus the term that the cut would add if it were a fixed edge (docs/derivations/radiance_boundary.md,
// section 6). Returns nothing if the polygon's extent exceeds kSmallSourceExtent of its distance. Vertices clockwise
// seen from the receiver for E > 0.
std::optional<AreaRuleSums> areaRule(const ClippedPolygon<double>& polygon, const Vector3<double>& normal);

}  // namespace irradiff
