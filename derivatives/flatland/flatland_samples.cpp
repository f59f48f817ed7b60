#include "derivatives/flatland/flatland_samples.h"

namespace irradiff {

FlatlandSamples sampleHalfCircle(const FlatlandStrata& strata, std::span<const double> offsets,
                                 const FlatlandRayQuery& cast_ray) {
  FlatlandSamples samples{strata, {}, {}};
  samples.directions.reserve(strata.count());
  samples.hits.reserve(strata.count());
  for (std::size_t i = 0; i < strata.count(); ++i) {
    samples.directions.push_back(strata.direction(i, offsets[i]));
    samples.hits.push_back(cast_ray(samples.directions.back()));
  }
  return samples;
}

}  // namespace irradiff
