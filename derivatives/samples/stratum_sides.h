#pragma once

#include "derivatives/samples/strata.h"

#include <array>
#include <cstddef>
#include <limits>

namespace irradiff {

/// The four sides of a stratum by the direction in the grid, in their cyclic order: towards the next column, the next
/// row, the previous column, the previous row.
inline constexpr std::size_t kStratumSides = 4;

/// In place of a stratum's number where there is none.
inline constexpr std::size_t kNoStratum = std::numeric_limits<std::size_t>::max();

/// The number (row times columns plus column) of the stratum across each side; kNoStratum at the horizon, at the pole
/// and where a ring is one stratum.
///
/// The rings of polar strata are closed. The half faces of a hemicube form a closed band of columns below the top face,
/// whose outermost texels touch its upper rows; there the rows of one face may meet the columns of the other.
std::array<std::size_t, kStratumSides> stratumNeighbours(const Strata& strata, std::size_t row, std::size_t column);

/// A side as a path from corner to corner, with the stratum on its left in the grid (columns to the right, rows up).
struct StratumSide {
  StratumPosition start;
  StratumPosition end;
};

StratumSide stratumSide(std::size_t row, std::size_t column, std::size_t side);

/// Calls visit(first, second, row, column, side) once for each side that two strata share: `first`, at `row` and
/// `column`, has `second` across `side`. Two strata that are a ring by themselves share two sides.
template <class Visit>
void forEachSharedSide(const Strata& strata, Visit visit) {
  const GridShape shape = strata.shape();
  for (std::size_t row = 0; row < shape.rows; ++row) {
    for (std::size_t column = 0; column < shape.columns; ++column) {
      const std::size_t first = row * shape.columns + column;
      const std::array<std::size_t, kStratumSides> neighbours = stratumNeighbours(strata, row, column);
      for (std::size_t side = 0; side < kStratumSides; ++side) {
        if (neighbours[side] != kNoStratum && first < neighbours[side]) {
          visit(first, neighbours[side], row, column, side);
        }
      }
    }
  }
}

}  // namespace irradiff
