#pragma once

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/form_factor/form_factor.h"
#include "derivatives/form_factor/pi.h"

namespace irradiff {

// Form factor of a polygon, its gradient and its Hessian from the radiance boundary; the part below the receiver's
// horizon does not count.
//   F = 1/(2 pi) n.sum Gamma_i                          Eq. (19) of [Schwarzhaupt et al. 2012], |Gamma_i| the arc's
//   angle grad F = 1/pi sum (r x e) s,  hess F = 1/pi sum { s [e]_x + (r x e)(4 q - I n)^T }
// docs/derivations/radiance_boundary.md. Equals Eq. (20), (21), sign corrected (docs/errata.md).
// Vertices and position in metres, any order and any number >= 3, convex or not; F > 0 when they run clockwise seen
// from the receiver. Units: 1, 1/m, 1/m^2. Error: docs/derivations/error_bounds.md. Requires |n| = 1 and a receiver on
// no edge. WideScalar is what geometry that cancels is computed in; Scalar itself leaves the compensation out. This is
// the formula alone, at any scalar: coordinates whose squares overflow, and polygons small compared with their
// distance, are the business of evaluatePolygon (derivatives/form_factor/polygon_evaluation.h).
template <class Scalar, class WideScalar = Wide<Scalar>>
FormFactor<Scalar> boundaryFormFactor(std::span<const Vector3<Scalar>> vertices, const Vector3<Scalar>& position,
                                      const Vector3<Scalar>& normal) {
  const ClippedPolygon<Scalar, WideScalar> clipped = clipAtHorizon<Scalar, WideScalar>(vertices, position, normal);
  const BoundarySums<Scalar> sums = boundarySums(polygonBoundary(clipped, normal), normal);
  const Scalar inverse_pi = lift<Scalar>(1.0) / pi<Scalar>();
  FormFactor<Scalar> result{sums.derivatives.irradiance.value * inverse_pi,
                            scaled(sums.derivatives.gradient.value, inverse_pi), sums.derivatives.hessian.value};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result.hessian(i, j) = result.hessian(i, j) * inverse_pi;
    }
  }
  return result;
}

}  // namespace irradiff
