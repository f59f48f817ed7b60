#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <vector>

namespace irradiff {

/// E = 1/2 sum dL n.Gamma over the visible arcs and those of the horizon, W/m^2, in plain double precision
/// (docs/derivations/radiance_boundary.md, section 1).
double arcIrradiance(const ExactVisibility& seen, const std::vector<Polygon>& polygons, const Receiver& receiver);

}  // namespace irradiff
