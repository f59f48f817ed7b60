#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "tests/closed_forms/adaptive_quadrature.h"

namespace irradiff::closed_forms_test {

/// The form factor by its definition, integral of (n.p)(N.p) / (pi |p|^4) over the polygon's area, in long double. The
/// polygon is convex, clockwise seen from the receiver and nowhere below its horizon.
Quadrature definingIntegral(const Polygon& polygon, const Receiver& receiver);

}  // namespace irradiff::closed_forms_test
