#pragma once

#include "derivatives/scene/invalid_scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// A planar simple polygon, convex or not, that radiates and blocks on both sides; vertex order does not matter.
/// Vertices in metres, radiance in W/(m^2 sr), constant over the polygon and all directions.
struct Polygon {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  double radiance = 0.0;
};

/// Distance that a vertex may have from the plane of its polygon, relative to the extent of the polygon (the largest
/// difference between two vertices in one coordinate), beside what rounding leaves: kPlanarityRounding.
inline constexpr double kPlanarityTolerance = 1e-10;

/// The same relative to the largest magnitude of a coordinate. Coordinates rounded to double move a vertex by up to
/// sqrt(3) 2^-53 of it, and the distance from a plane through three of the vertices by up to 8 times that; 2^-49 is
/// above. So a planar polygon stays planar wherever it is rotated and translated before its coordinates are rounded.
inline constexpr double kPlanarityRounding = 0x1p-49;

/// A polygon without an area in the sense of `validate`: it neither radiates nor blocks.
class PolygonWithoutArea : public InvalidScene {
 public:
  using InvalidScene::InvalidScene;
};

/// A polygon that has an area, and is not planar in the sense of `validate`: parts of it may be.
class NonPlanarPolygon : public InvalidScene {
 public:
  using InvalidScene::InvalidScene;
};

/// Throws InvalidScene naming the polygon (by name and `index`), the vertex, the value and the rule, unless the polygon
/// has
///   - at least 3 vertices, all finite, no two of them equal, and a finite radiance >= 0;
///   - an area: its vertices are not on one line to within the rounding of their coordinates. The rounding is taken for
///   each
///     coordinate axis by itself, so an axis-aligned sliver may be as thin as double can express, and a rotated one
///     about 10^15 times thinner than long;
///   - one plane: every vertex within kPlanarityTolerance * extent + kPlanarityRounding * largest |coordinate| of the
///   plane
///     through three of its vertices, the first one, the one farthest from it, and the one farthest from the line
///     through both. The widest triangle keeps the plane well defined for slivers, where an area-weighted normal is
///     lost;
///   - no two edges that meet anywhere but in their common vertex. Judged exactly on the coordinates given, after
///   dropping the
///     one in which the plane is steepest. (A coordinate below 2^-960 of the largest along its axis counts as 0 here.)
/// Coordinates of any magnitude; time n log n for n vertices. In this order: what is not planar has distinct vertices
/// and an area. PolygonWithoutArea and NonPlanarPolygon are the exceptions of the rules on area and plane.
void validate(const Polygon& polygon, std::size_t index);

}  // namespace irradiff
