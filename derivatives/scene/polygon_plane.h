#pragma once

#include <Eigen/Core>

#include <vector>

namespace irradiff {

/// The vertices of a polygon relative to the first one, scaled by a power of two so that the extent is in [1/2, 1).
struct LocalShape {
  std::vector<Eigen::Vector3d> vertices;
  Eigen::Vector3d extents = Eigen::Vector3d::Zero();   ///< largest difference between two vertices along each axis
  double extent = 0;                                   ///< the largest of them
  Eigen::Vector3d rounding = Eigen::Vector3d::Zero();  ///< at most one ulp of the largest coordinate along each axis
  double largest_coordinate = 0;                       ///< of the vertices before the translation
  int exponent = 0;                                    ///< in metres, all of this is 2^exponent times larger
};

/// Requires finite vertices, not all equal.
LocalShape localShape(const std::vector<Eigen::Vector3d>& vertices);

/// Normal of the widest triangle of a local shape (twice its area long): the first vertex, the one farthest from it,
/// and the one farthest from the line through both. Zero where all vertices are on one line.
Eigen::Vector3d widestNormal(const std::vector<Eigen::Vector3d>& local);

/// The polygon without the coordinate in which the plane with this normal is steepest; each axis scaled by its own
/// power of two, which keeps all orientations, into the range that `orientation` requires. A coordinate below 2^-960 of
/// the largest along its axis becomes 0.
std::vector<Eigen::Vector2d> projection(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& normal);

}  // namespace irradiff
