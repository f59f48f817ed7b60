#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/scene_mesh.h"
#include "derivatives/visibility/visible_boundary.h"

#include <span>

namespace irradiff {

/// The receiver's position in units of the mesh.
Eigen::Vector3d positionIn(const SceneMesh& mesh, const Receiver& receiver);

/// The unit in which what is partly hidden is integrated: 2^exponent units of the mesh, in which the farthest point
/// that bounds it is about 1 away. Products of doubled precision then neither overflow nor lose their low words to
/// underflow, whatever else is in the scene.
struct ViewUnit {
  int exponent;
  Eigen::Vector3d position;  ///< of the receiver
};

/// `radiances` of the polygons, as boundaryOfView takes them.
ViewUnit viewUnit(const SceneMesh& mesh, const VisibleBoundary& view, std::span<const double> radiances,
                  const Receiver& receiver);

}  // namespace irradiff
