#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace irradiff {

/// A place across a row or a column of strata, from 0 to 1, with its distances from both ends: each has a relative
/// error of a few units in the last place, also next to an end, where the difference of the other from 1 has none.
struct GridCoordinate {
  double from_start = 0.0;
  double from_end = 1.0;

  /// From -1 to 1, accurate relative to itself.
  double centred = -1.0;
};

/// A cell out of `count` and the place in it, from 0 to 1.
struct GridCell {
  std::size_t index = 0;
  double along = 0.5;
};

/// Requires index < count <= 2^16 and 0 <= along <= 1.
inline GridCoordinate gridCoordinate(const GridCell& cell, std::size_t count) {
  const auto before = static_cast<double>(cell.index);
  const auto all = static_cast<double>(count);
  // Whole numbers are exact, so each sum and each quotient is rounded once.
  return {(before + cell.along) / all, ((all - before) - cell.along) / all,
          ((2.0 * before - all) + 2.0 * cell.along) / all};
}

/// Inverse of `gridCoordinate`, counted from the nearer end.
inline GridCell gridCell(double from_start, double from_end, std::size_t count) {
  const bool from_nearer_start = from_start <= from_end;
  const double cells = (from_nearer_start ? from_start : from_end) * static_cast<double>(count);
  const double whole = std::min(std::floor(cells), static_cast<double>(count - 1));
  const auto index = static_cast<std::size_t>(whole);
  const double along = std::min(cells - whole, 1.0);
  return from_nearer_start ? GridCell{index, along} : GridCell{count - 1 - index, 1.0 - along};
}

/// Inverse of the coordinate from -1 to 1.
inline GridCell gridCell(double centred, std::size_t count) {
  return gridCell((1.0 + centred) / 2.0, (1.0 - centred) / 2.0, count);
}

/// Where a coordinate of all cells is in cell `index`, or the end of that cell it is nearest to.
inline double nearestAlong(std::size_t index, double coordinate) {
  return std::clamp(coordinate - static_cast<double>(index), 0.0, 1.0);
}
inline double nearestAlong(std::size_t index, const GridCell& cell) {
  return cell.index == index ? cell.along : nearestAlong(index, static_cast<double>(cell.index) + cell.along);
}

}  // namespace irradiff
