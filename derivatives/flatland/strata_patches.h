#pragma once

#include "derivatives/flatland/flatland_estimate.h"
#include "derivatives/flatland/flatland_samples.h"

namespace irradiff {

// Estimators that know no occlusion: each stratum counts as a small patch of surface that stays where the stratum's ray
// hit, whatever moves before or behind it. docs/derivations/flatland.md, section 6. A miss is infinitely far. The entry
// (n, n) of a Hessian holds for patches that the horizon does not cut.

/// The derivatives of the projected angles of texels (Castaño, "Irradiance Caching - Part 1", 2011, section
/// "Translation Gradients", the first approach, which the article shows to fail), carried to flatland: patches are
/// parallel to their sides of the square, at the depths of their hits. Gradient and Hessian. Requires square strata.
FlatlandEstimate estimateHemicubeTexel(const FlatlandSamples& samples);

/// The radiometric gradient and Hessian (Jarosz, Schönefeld, Kobbelt, Jensen, "Theory, Analysis and Applications of 2D
/// Global Illumination", 2012): patches lie along the surfaces. Samples have no normals: the line of a surface goes
/// through the hit and the one of the two neighbouring hits that gives the line farther from the receiver, since one
/// beyond an edge gives a steeper line. A hit without neighbours faces the receiver. Right where nothing is hidden;
/// wrong without limit where something is uncovered.
FlatlandEstimate estimateRadiometric(const FlatlandSamples& samples);

/// The geometric Hessian (Jarosz et al. 2012; section 3 of Schwarzhaupt et al. 2012), which ignores where radiance
/// comes from: the sum of the absolute values of the tangential second derivatives of the radiometric patches at the
/// mean radiance E/2. It bounds the radiometric one of every radiance between 0 and E/2 from both sides. Nothing else.
FlatlandEstimate estimateGeometric(const FlatlandSamples& samples);

}  // namespace irradiff
