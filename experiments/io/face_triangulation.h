#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace irradiff {

/// Most vertices of a face that is split.
inline constexpr std::size_t kMaxSplitVertices = 4096;

/// Triangles between the vertices of a face that need not be planar or convex, as indices in the order of the face:
/// n - 2 of them for n vertices, whose outer edges are the edges of the face. Found by clipping ears ("Triangulation by
/// ear clipping", Eberly 2002) in the projection along a coordinate axis, the ear with the shortest diagonal first, so
/// that a quadrilateral is split along its shorter diagonal where both are inside. Signs are exact. Of the axes the one
/// that the face's normal (Newell's) is nearest to is tried first. Nothing where the face is not simple in any of the
/// three projections, or has more than kMaxSplitVertices. Requires finite vertices, at least 3. Time n^2.
std::optional<std::vector<std::array<std::size_t, 3>>> triangulation(std::span<const Eigen::Vector3d> vertices);

}  // namespace irradiff
