#pragma once

#include "derivatives/visibility/scene_in_view.h"
#include "derivatives/visibility/visible_boundary.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// Where what is seen just above the horizon changes, counterclockwise seen from above: the ends of arcs there.
std::vector<HorizonPlace> placesOnHorizon(const SceneInView& scene, std::span<const VisibleArc> arcs);

/// Why the Hessian along the normal does not exist: a crease between polygons of different radiance that lies on the
/// horizon. Empty if there is none.
std::optional<std::string> creaseOnHorizon(const SceneInView& scene);

}  // namespace irradiff
