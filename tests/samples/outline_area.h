#pragma once

#include "derivatives/samples/strata.h"

#include <Eigen/Core>

#include <functional>

namespace irradiff {

/// A map from a grid of strata to directions, right or wrong.
using DirectionMap = std::function<Eigen::Vector3d(const StratumPosition&)>;

/// A rectangle in the grid: coordinates count strata, columns and rows, from the grid's first corner.
struct GridRectangle {
  double column_low, column_high, row_low, row_high;
};

/// An area found by quadrature and how far it is from the one with half as many nodes.
struct MeasuredArea {
  double value;
  double change;
};

/// The areas that the image of a rectangle's outline encloses, by line integrals along it: no weight, no Jacobian and
/// no inverse of the map is asked for. Positive where the outline, columns first, runs counterclockwise seen from
/// above. The outline is cut where it crosses the grid's diagonals, on which the concentric map has a corner: on each
/// piece the error falls with the square of the number of nodes, and `change` is three times what is left.
struct OutlineAreas {
  MeasuredArea projected_solid_angle;  ///< half of the integral of t db - b dt
  MeasuredArea solid_angle;            ///< the integral of 1 - n over the azimuth
};
OutlineAreas outlineAreas(const DirectionMap& map, const GridShape& shape, const GridRectangle& rectangle);

}  // namespace irradiff
