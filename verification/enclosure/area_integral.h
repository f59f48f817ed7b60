#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/enclosure/form_factor_enclosure.h"

namespace irradiff {

/// Encloses the defining area integral
///   F = 1/pi integral over the polygon of max(0, n.p) (N.p) / |p|^4 dA,   p = y - x,
/// its gradient, its Hessian and its gradient with respect to n. The kernel is differentiated under the integral sign;
/// the motion of the cut at the horizon adds a line integral to the Hessian (docs/derivations/area_integral.md) and
/// nothing to the others, since the kernel vanishes on it. Two nested one-dimensional rigorous
/// integrations (acb_calc_integrate) of rational functions; no closed form, no boundary formula.
///
/// A polygon of more than three vertices is the signed fan of triangles from vertex 0, each with its own plane.
/// Raises the working precision until correctDigits() is at least `digits`. For moderate geometry: time grows as
/// (size/distance) and with the square of the digits; see enclosePolar for the rest. Throws std::domain_error when a
/// vertex is on the horizon and std::runtime_error when the digits are not reached (the receiver is too near the
/// polygon).
FormFactorEnclosure encloseArea(const Polygon& polygon, const Receiver& receiver, int digits);

}  // namespace irradiff
