#pragma once

#include "derivatives/flatland/flatland_estimate.h"
#include "derivatives/flatland/flatland_samples.h"

#include <Eigen/Core>

#include <span>

namespace irradiff {

// Irradiance and rotational gradient of windows through each of which its own radiance comes, window i from borders[i]
// counterclockwise to borders[i + 1]:
//   E = sum L_i (w_i - w_i+1).t,   dE/dalpha = sum L_i (w_i - w_i+1).n,
// the integrals of n.w and of (J n).w = -t.w over the window (docs/derivations/flatland.md, section 6). All else has no
// value. Borders are unit directions in the frame (t, n), one more than there are hits.
FlatlandEstimate windowSums(std::span<const Eigen::Vector2d> borders, std::span<const FlatlandHit> hits);

/// The same with the strata as windows: what every estimator from samples reports beside its translational derivatives.
FlatlandEstimate strataSums(const FlatlandSamples& samples);

}  // namespace irradiff
