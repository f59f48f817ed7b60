#pragma once

#include "experiments/cache_2d/seen_piece.h"

#include <Eigen/Core>

namespace irradiff {

// The integral of |d^2 k/ds^2| over what is seen of the wall start + u step, k = dS/du the weight with which radiance
// at u counts and s the place of the receiver: the total variation of S_tt = 3 h^2 x/rho^5 along the wall. Its extrema
// are at the z = x/h that solve
//   2 step_h z^3 - 4 step_x z^2 - 3 step_h z + step_x = 0,
// three real roots (docs/derivations/flatland_bounce.md, section 5). 1/m^2. Points in the receiver's frame.
double kernelCurvature(const Eigen::Vector2d& start, const Eigen::Vector2d& step, const SeenEnd& first,
                       const SeenEnd& last);

}  // namespace irradiff
