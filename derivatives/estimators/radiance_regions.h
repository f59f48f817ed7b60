#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// Two neighbouring rays by their numbers.
using NeighbourPair = std::array<std::size_t, 2>;

// Parts rays into regions of one radiance each, so that what remains, the radiance less that of its region, is smooth:
// rays are in one region if a path of neighbours leads from one to the other on which nothing stands out, no difference
// above 8 times the median of those where radiance varies: between neighbours that are both alone, with no other ray of
// their radiance within two steps. Returns the mean radiance of each ray's region.
// Where there are fewer than 4 of these, radiance is constant but for its jumps: that is the ray's own.
std::vector<double> regionRadiance(std::span<const double> radiance, std::span<const NeighbourPair> neighbours);

}  // namespace irradiff
