#pragma once

#include "derivatives/boundary/horizon_clip.h"
#include "derivatives/boundary/irradiance.h"

#include <optional>

namespace irradiff {

/// Irradiance of a polygon of radiance 1 and its derivatives, with the sizes that their errors are proportional to.
struct AreaRuleSums {
  IrradianceDerivatives<double> derivatives;
  double irradiance_size;
  double gradient_size;
  double hessian_size;
  double truncation;  ///< bound of the quadrature error, relative to the sizes
};

/// Largest extent of a polygon, relative to its distance, that the area rule takes. Above it the boundary form loses less than a decimal digit and a half
/// to cancellation between edges.
inline constexpr double kAreaRuleExtent = 0.1;

/// Relative error of the terms at one node in units of u times their size (docs/derivations/error_bounds.md).
inline constexpr double kAreaError = 64.0;

// The area rule: the defining integral over a polygon that is small compared with its distance, and its kernel's derivatives under the integral sign,
//   E = int (n.p)(N.p)/|p|^4 dA,
// by tensor Gauss-Legendre quadrature on the triangles of a fan. A sum over edges loses distance/size to cancellation; here nothing cancels.
// Where the polygon is cut at the horizon, the Hessian has in addition the motion of the cut: m int 1/|p|^2 dphi n^T, m being the normal of the
// plane of horizon directions on the polygon's side (docs/derivations/radiance_boundary.md, section 6).
// Returns nothing if the polygon's extent exceeds kAreaRuleExtent of its distance. Vertices relative to the receiver, clockwise seen from it.
std::optional<AreaRuleSums> areaRule(const ClippedPolygon<double>& polygon, const Vector3<double>& normal);

}  // namespace irradiff
