#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/enclosure/form_factor_enclosure.h"

namespace irradiff {

/// F by Lambert's contour formula, 1/(2 pi) sum over the edges of the visible contour, horizon edges included, of n.(r
/// x r') times the edge's angle over its sine; gradient and Hessian by central differences of F: the receiver is
/// displaced by 1e-43 and 1e-44 of the smallest length of the scene, at 300 digits, and the normal likewise. Each
/// radius holds the rounding and, estimated by the difference between the two steps, the truncation: an estimate, not a
/// proof. Shares with the area integrals only the cut at the horizon; nothing is differentiated by hand. Throws
/// std::domain_error when a vertex is on the horizon.
FormFactorEnclosure differenceContour(const Polygon& polygon, const Receiver& receiver);

}  // namespace irradiff
