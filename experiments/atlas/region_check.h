#pragma once

#include "experiments/atlas/safe_region.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace irradiff {

/// Inputs with which regions are put to the test: random ones that have been no part of a map.
struct RegionProbes {
  std::string_view stream;  ///< of the random numbers: different ones for different purposes
  std::uint64_t seed = 1;
  std::size_t polygon_inputs = 1000;  ///< for each polygon map
  std::size_t scene_inputs = 100;     ///< for the map of visibility events
};

/// One fresh input: its place in the map, and each variant's errors.
struct RegionProbe {
  std::size_t map = 0;
  std::array<double, 2> drawn{};
  ErrorProbe found;
};

/// Draws places and inputs for maps in the order of an atlas, the polygon maps and then that of events. Half of the
/// places are anywhere in their map; the others are just inside the bounds of a statement's region, within half a
/// decade, where errors are largest. Results do not depend on threads. Throws as trueFormFactor.
std::vector<RegionProbe> probeRegions(const std::vector<StabilityMap>& maps,
                                      const std::vector<SafetyStatement>& statements, const RegionProbes& probes,
                                      unsigned threads, const QualityProgress& progress);

/// Counts in each statement the probes inside its region, and those with an error above its tolerance.
void countViolations(const std::vector<StabilityMap>& maps, const std::vector<RegionProbe>& probes,
                     std::vector<SafetyStatement>& statements);

/// Puts the errors of the probes into the cells that they were drawn in, where they are larger.
void raisePeaks(const std::vector<RegionProbe>& probes, std::vector<StabilityMap>& maps);

}  // namespace irradiff
