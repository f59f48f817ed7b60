#pragma once

#include "derivatives/samples/strata.h"
#include "derivatives/samples/stratum_sides.h"

#include <Eigen/Core>

namespace irradiff {

/// A side of a hemicube texel on the unit sphere: an arc of a great circle.
struct TexelWall {
  Eigen::Vector3d outer_normal;  ///< unit normal of the great circle's plane, out of the texel
  double length = 0.0;           ///< rad
  double cosine_integral = 0.0;  ///< of n.w along the arc
};

/// Requires hemicube strata.
TexelWall texelWall(const Strata& strata, const StratumSide& side);

}  // namespace irradiff
