#pragma once

#include "derivatives/boundary/irradiance.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/scene_mesh.h"
#include "derivatives/visibility/visible_boundary.h"

#include <span>

namespace irradiff {

// The tangential Hessian of what is seen if nothing of it moves: of the visible pieces of polygons, cut out where they
// are, each of which counts as wholly visible from everywhere. It is what `radiometric` tends to with ever more rays
// (Jarosz et al. 2012, carried to 3D). Along an edge that hides a part of a farther polygon, that polygon is bounded by
// the edge's shadow on it, which stays. `radiances` of the polygons of the mesh in W/(m^2 sr); `view` is that of the
// receiver. W/m^4. docs/derivations/reprojection.md, section 8. Requires polygons that are planar to
// rounding.
TangentialHessian<double> staticPiecesHessian(const SceneMesh& mesh, const VisibleBoundary& view,
                                              std::span<const double> radiances, const Receiver& receiver);

}  // namespace irradiff
