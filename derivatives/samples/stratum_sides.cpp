#include "derivatives/samples/stratum_sides.h"

namespace irradiff {

namespace {

constexpr std::size_t kNextColumn = 0;
constexpr std::size_t kNextRow = 1;
constexpr std::size_t kPreviousColumn = 2;
constexpr std::size_t kPreviousRow = 3;

/// Neighbours in a plain grid.
std::array<std::size_t, kStratumSides> gridNeighbours(const GridShape& shape, std::size_t row, std::size_t column) {
  const std::size_t stratum = row * shape.columns + column;
  return {column + 1 < shape.columns ? stratum + 1 : kNoStratum,
          row + 1 < shape.rows ? stratum + shape.columns : kNoStratum, column > 0 ? stratum - 1 : kNoStratum,
          row > 0 ? stratum - shape.columns : kNoStratum};
}

std::array<std::size_t, kStratumSides> polarNeighbours(const GridShape& shape, std::size_t row, std::size_t column) {
  std::array<std::size_t, kStratumSides> neighbours = gridNeighbours(shape, row, column);
  if (shape.columns == 1) return neighbours;
  if (column + 1 == shape.columns) neighbours[kNextColumn] = row * shape.columns;
  if (column == 0) neighbours[kPreviousColumn] = (row + 1) * shape.columns - 1;
  return neighbours;
}

/// The faces of a hemicube of resolution n, as stratification.h lays them out.
class HemicubeFaces {
 public:
  explicit HemicubeFaces(std::size_t resolution) : resolution_(resolution) {}

  std::array<std::size_t, kStratumSides> ofTopTexel(std::size_t row, std::size_t column) const {
    const std::size_t last = resolution_ - 1;
    std::array<std::size_t, kStratumSides> neighbours = gridNeighbours({resolution_, resolution_}, row, column);
    // Columns of the half faces run counterclockwise.
    if (column == last) neighbours[kNextColumn] = bandTexel(0, row);
    if (row == last) neighbours[kNextRow] = bandTexel(1, last - column);
    if (column == 0) neighbours[kPreviousColumn] = bandTexel(2, last - row);
    if (row == 0) neighbours[kPreviousRow] = bandTexel(3, column);
    return neighbours;
  }

  std::array<std::size_t, kStratumSides> ofHalfFaceTexel(std::size_t face, std::size_t row, std::size_t column) const {
    const std::size_t half = resolution_ / 2;
    const std::size_t last = resolution_ - 1;
    return {column < last ? texel(face, row, column + 1) : texel((face + 1) % 4, row, 0),
            row + 1 < half ? texel(face, row + 1, column) : topTexel(face, column),
            column > 0 ? texel(face, row, column - 1) : texel((face + 3) % 4, row, last),
            row > 0 ? texel(face, row - 1, column) : kNoStratum};
  }

 private:
  std::size_t texel(std::size_t face, std::size_t row, std::size_t column) const {
    return (resolution_ + face * (resolution_ / 2) + row) * resolution_ + column;
  }

  /// In the uppermost row of a half face.
  std::size_t bandTexel(std::size_t face, std::size_t column) const { return texel(face, resolution_ / 2 - 1, column); }

  /// On the top face, above the column of a half face.
  std::size_t topTexel(std::size_t face, std::size_t column) const {
    const std::size_t last = resolution_ - 1;
    switch (face) {
      case 0:
        return column * resolution_ + last;
      case 1:
        return last * resolution_ + (last - column);
      case 2:
        return (last - column) * resolution_;
      default:
        return column;
    }
  }

  std::size_t resolution_;
};

}  // namespace

std::array<std::size_t, kStratumSides> stratumNeighbours(const Strata& strata, std::size_t row, std::size_t column) {
  const GridShape shape = strata.shape();
  switch (strata.stratification()) {
    case Stratification::kPolar:
      return polarNeighbours(shape, row, column);
    case Stratification::kConcentric:
      return gridNeighbours(shape, row, column);
    case Stratification::kHemicube:
      break;
  }
  const HemicubeFaces faces(shape.columns);
  if (row < shape.columns) return faces.ofTopTexel(row, column);
  const std::size_t half = shape.columns / 2;
  const std::size_t below_top = row - shape.columns;
  return faces.ofHalfFaceTexel(below_top / half, below_top % half, column);
}

StratumSide stratumSide(std::size_t row, std::size_t column, std::size_t side) {
  // Corners counterclockwise from the first of both coordinates.
  const auto corner = [row, column](std::size_t index) {
    return StratumPosition{row, column, index == 1 || index == 2 ? 1.0 : 0.0, index >= 2 ? 1.0 : 0.0};
  };
  const std::size_t start = (side + 1) % kStratumSides;
  return {corner(start), corner((start + 1) % kStratumSides)};
}

}  // namespace irradiff
