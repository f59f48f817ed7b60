#pragma once

#include "derivatives/visibility/visible_boundary.h"

#include <span>

namespace irradiff {

/// What of a view shows in the irradiance: polygons of equal radiance, black ones and the background are taken for one
/// (by the index of the first, kNone for what is black), and arcs and places between equals are left out. So one black
/// polygon that passes behind another is no event. `radiances` has one for each polygon of the scene.
VisibleBoundary radianceTopology(const VisibleBoundary& view, std::span<const double> radiances);

}  // namespace irradiff
