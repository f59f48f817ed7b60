#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>

namespace irradiff {

/// Two edges of a polygon; edge i runs from vertex i to the next one.
struct EdgePair {
  std::size_t first;
  std::size_t second;
};

/// Two edges of the polygon that meet anywhere but in their common vertex (they cross, touch or overlap), first <
/// second, or nothing where the polygon is simple. Exact; time n log n for n vertices: the plane sweep of Shamos and
/// Hoey, "Geometric intersection problems" (1976), which stops at the first meeting it sees. Requires at least 3
/// vertices, all distinct, with coordinates as `orientation` requires them.
std::optional<EdgePair> meetingEdges(std::span<const Eigen::Vector2d> vertices);

}  // namespace irradiff
