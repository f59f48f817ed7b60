#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace irradiff {

/// Called with the numbers of two neighbouring rays.
using NeighbourVisitor = std::function<void(std::size_t, std::size_t)>;

/// Calls the visitor once for each two neighbours, in the same order each time.
using Neighbours = std::function<void(const NeighbourVisitor&)>;

// Parts rays into regions of one radiance each, so that what remains, the radiance less that of its region, is smooth:
// rays are in one region if a path of neighbours leads from one to the other on which nothing stands out, no difference
// above 8 times the median of those where radiance varies: between neighbours that are both alone, with no other ray of
// their radiance within two steps. Returns the mean radiance of each ray's region.
// Where there are fewer than 4 of these, radiance is constant but for its jumps: that is the ray's own.
// Requires fewer than 2^32 rays.
std::vector<double> regionRadiance(std::span<const double> radiance, const Neighbours& neighbours);

}  // namespace irradiff
