#pragma once

#include "derivatives/flatland/flatland_estimate.h"
#include "derivatives/flatland/flatland_samples.h"

namespace irradiff {

/// Gradient and Hessian from the polyline through the samples' hits, each segment with the radiance of its farther end:
/// section 4.1 and Figure 2 (D) of [Schwarzhaupt et al. 2012]. The polyline ends at the outermost samples, so the
/// derivatives of constant radiance are not zero. A miss is infinitely far; of two ends equally far the first counts. A
/// single sample has no polyline and gives no derivatives of position. docs/derivations/flatland.md, section 6.
FlatlandEstimate estimateTriangulated(const FlatlandSamples& samples);

/// The same with the polyline continued from each outermost sample to the horizon, with that sample's radiance:
/// constant radiance gives exactly zero.
FlatlandEstimate estimateTriangulatedClosed(const FlatlandSamples& samples);

}  // namespace irradiff
