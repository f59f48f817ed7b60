#pragma once

#include "derivatives/flatland/flatland_estimate.h"
#include "derivatives/flatland/flatland_samples.h"

namespace irradiff {

// The gradient from the walls between strata (Ward and Heckbert, "Irradiance Gradients", 1992), carried to flatland:
// a wall is a point in the direction of a border, at the nearer of the distances beside it,
//   dE/dt = -sum over walls of (L_i+1 - L_i) u nu^2,   u the greater of 1/r_i and 1/r_i+1, nu = n.w of the wall.
// Along the tangent alone; no Hessian. Constant radiance gives exactly 0. Any strata. docs/derivations/flatland.md,
// section 6.
FlatlandEstimate estimateWardHeckbert(const FlatlandSamples& samples);

// The gradient from the walls between texels (Castaño, "Irradiance Caching - Part 1", 2011, section "Translation
// Gradients", the second approach), carried to flatland: each texel's angle changes with its walls and its cosine does
// not,
//   dE/dt = -sum over walls of (L_i+1 c_i+1 - L_i c_i) u nu,   c_i the cosine at the middle of a texel.
// Along the tangent alone; no Hessian. As in space the limit lacks the change of the cosine, and constant radiance does
// not give 0. Requires square strata.
FlatlandEstimate estimateHemicube(const FlatlandSamples& samples);

}  // namespace irradiff
