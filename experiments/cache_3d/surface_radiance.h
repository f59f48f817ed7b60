#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/scene/polygon.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace irradiff {

/// Radiance at the nodes of a grid in the plane of a face, bilinear between them and continued beyond them, but never
/// negative. W/(m^2 sr).
struct RadianceGrid {
  std::size_t columns = 2;  ///< at least 2
  std::size_t rows = 2;
  std::vector<double> values;  ///< row by row; empty: dark everywhere

  /// At a place in units of the grid's spacing, node (0, 0) being the origin.
  double at(double column, double row) const {
    const std::size_t i = cell(column, columns);
    const std::size_t j = cell(row, rows);
    const double x = column - static_cast<double>(i);
    const double y = row - static_cast<double>(j);
    const double* const corner = values.data() + j * columns + i;
    const double lower = corner[0] + x * (corner[1] - corner[0]);
    const double upper = corner[columns] + x * (corner[columns + 1] - corner[columns]);
    return std::max(0.0, lower + y * (upper - lower));
  }

  /// The same with its slopes, per unit of the grid's spacing.
  struct Slope {
    double value, per_column, per_row;
  };
  Slope slopeAt(double column, double row) const {
    const std::size_t i = cell(column, columns);
    const std::size_t j = cell(row, rows);
    const double x = column - static_cast<double>(i);
    const double y = row - static_cast<double>(j);
    const double* const corner = values.data() + j * columns + i;
    const double lower_slope = corner[1] - corner[0];
    const double upper_slope = corner[columns + 1] - corner[columns];
    const double lower = corner[0] + x * lower_slope;
    const double rise = corner[columns] + x * upper_slope - lower;
    const double value = lower + y * rise;
    if (!(value > 0.0)) return {0.0, 0.0, 0.0};
    return {value, lower_slope + y * (upper_slope - lower_slope), rise};
  }

 private:
  /// The first of the two nodes between which, or beyond which, a place is.
  static std::size_t cell(double place, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count) - 1.5));
  }
};

/// One face as a receiver sees it, in the receiver's frame (t, b, n): which of its sides, and where in that side's grid
/// a point p of the face is, p from the receiver: first + across.p and so on.
struct SurfaceView {
  const RadianceGrid* grid = nullptr;  ///< null where the receiver is in the face's plane
  double first_column = 0.0;
  double first_row = 0.0;
  Eigen::Vector3d across;  ///< columns per metre
  Eigen::Vector3d along;   ///< rows per metre
};

/// The radiance that leaves both sides of a scene's faces, the same in all directions, as a table. The table is the
/// definition: whoever gathers and whoever makes a reference reads the same numbers.
class SurfaceRadiance {
 public:
  /// Radiance at a point of polygon number `face` on the side that the unit normal points to. W/(m^2 sr).
  using Function =
      std::function<double(std::size_t face, const Eigen::Vector3d& position, const Eigen::Vector3d& normal)>;

  /// Nodes in the middle of cells of at most `spacing` metres, which fill the smallest rectangle about each polygon
  /// that has a side along the polygon's longest edge. Nodes that lie outside the polygon are asked for as well, in its
  /// plane. Requires validated polygons and spacing > 0.
  SurfaceRadiance(std::span<const Polygon> polygons, double spacing, const Function& radiance, unsigned threads);

  std::size_t faceCount() const { return faces_.size(); }

  /// Unit normal of a face's first side.
  const Eigen::Vector3d& normal(std::size_t face) const { return faces_[face].normal; }

  /// Throws nothing; a receiver that is in the plane of a face to within rounding has no view of it.
  SurfaceView view(std::size_t face, const SampleFrame& frame) const;

  /// At a point of the face's side that `viewer` is on. Slower than through a view.
  double at(std::size_t face, const Eigen::Vector3d& position, const Eigen::Vector3d& viewer) const;

 private:
  struct Face {
    Eigen::Vector3d first_node;
    Eigen::Vector3d column_axis, row_axis;  ///< unit, in the plane
    Eigen::Vector3d normal;
    double column_spacing = 1.0, row_spacing = 1.0;
    double plane_rounding = 0.0;        ///< distance from the plane that counts as none; m
    std::array<RadianceGrid, 2> sides;  ///< the one that the normal points to, and the other
  };

  static Face layOut(const Polygon& polygon, double spacing);

  std::vector<Face> faces_;
};

}  // namespace irradiff
