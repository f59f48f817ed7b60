#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"

namespace irradiff {

/// The harmonic mean distance of what the samples hit: 1/R = 1/pi times the integral of cos/r over the hemisphere, a
/// stratum's sample standing for its projected solid angle. Metres, infinite where every ray misses. It is a mean: one
/// near hit among N moves 1/R by 1/N of its own 1/r, where the nearest distance would be that hit's alone (Ward,
/// Rubinstein, Clear, "A Ray Tracing Solution for Diffuse Interreflection", 1988: the R_i of the split-sphere model).
/// Requires samples of the strata's stratification and shape.
double harmonicMeanDistance(const HemisphereSamples& samples, const Strata& strata);

}  // namespace irradiff
