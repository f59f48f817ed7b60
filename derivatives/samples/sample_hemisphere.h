#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/ray_query.h"
#include "derivatives/samples/sample_pattern.h"
#include "derivatives/samples/strata.h"

#include <cstdint>

namespace irradiff {

/// One ray through each stratum, row by row: what renderers gather at a cache record. The offsets in the strata are
/// those of stratumOffset(pattern, seed, point, sample), the sample's number being row * columns + column.
///
/// Requires a right-handed orthonormal frame; `cast_ray` gives finite numbers >= 0, as HemisphereSamples holds.
HemisphereSamples sampleHemisphere(const Strata& strata, SamplePattern pattern, std::uint64_t seed, std::uint64_t point,
                                   const SampleFrame& frame, const RayQuery& cast_ray);

}  // namespace irradiff
