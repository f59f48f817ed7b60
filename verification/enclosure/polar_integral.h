#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/enclosure/form_factor_enclosure.h"

namespace irradiff {

/// Encloses F, its gradient, its Hessian and its gradient with respect to n by the defining area integral in polar
/// coordinates about the receiver's foot on the plane of each triangle of the fan from vertex 0: the radial integral in
/// closed form, the one along the edges by validated quadrature, the derivatives by differentiating under it, the
/// motion of the cut at the horizon included. docs/derivations/area_integral.md. Serves every geometry but a receiver
/// exactly in a triangle's plane; the price grows with the logarithm of size over distance to an edge's line.
///
/// Raises the working precision until correctDigits() is at least `digits`. Throws std::domain_error when a vertex is
/// on the horizon or the receiver in the plane of a triangle, and std::runtime_error when 16 times the first precision
/// does not suffice (the receiver is on an edge).
FormFactorEnclosure enclosePolar(const Polygon& polygon, const Receiver& receiver, int digits);

}  // namespace irradiff
