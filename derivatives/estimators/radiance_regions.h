#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// Two neighbouring rays by their numbers.
using NeighbourPair = std::array<std::size_t, 2>;

// Parts rays into regions of one radiance each, so that what remains, the radiance less that of its region, is smooth:
// rays are in one region if a path of neighbours leads from one to the other without a difference above
// jumpThreshold(). Returns the mean radiance of each ray's region. Where radiance is constant but for its jumps (the
// threshold is 0), that is the ray's own.
std::vector<double> regionRadiance(std::span<const double> radiance, std::span<const NeighbourPair> neighbours);

}  // namespace irradiff
