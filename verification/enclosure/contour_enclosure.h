#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/enclosure/form_factor_enclosure.h"

namespace irradiff {

/// Encloses F by Lambert's contour formula, 1/(2 pi) sum over the edges of the visible contour, horizon edges included,
/// of n.(r x r') times the edge's angle over its sine, and its derivatives by Taylor arithmetic of second order on that
/// formula, the motion of cuts at the horizon included: nothing is differentiated by hand, no integral along an edge
/// is written down. Trusts Lambert's formula, which the area integrals prove; a thousand times as fast as they are.
///
/// The contour is that of the polygon's vertices, planar or not. Raises the working precision until correctDigits() is
/// at least `digits`. Throws std::domain_error when a vertex is on the horizon and std::runtime_error when 64 times the
/// first precision does not suffice (the receiver is on an edge).
FormFactorEnclosure encloseContour(const Polygon& polygon, const Receiver& receiver, int digits);

}  // namespace irradiff
