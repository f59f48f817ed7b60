#pragma once

#include "derivatives/samples/stratification.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace irradiff {

/// Most rows, and most columns, that a grid of strata may have.
inline constexpr std::size_t kMostStrataInLine = std::size_t{1} << 16;

/// A place in the grid of strata: the stratum and the position in it, both coordinates in [0, 1].
struct StratumPosition {
  std::size_t row = 0;
  std::size_t column = 0;
  double along_row = 0.5;     ///< grows with the column
  double along_column = 0.5;  ///< grows with the row
};

/// The map between a grid of strata and the hemisphere of directions, in the frame (t, b, n).
///
/// Polar and concentric strata preserve area: equal areas of the grid have equal projected solid angles. A hemicube's
/// do not; its strata have the weights below.
class Strata {
 public:
  /// Throws std::invalid_argument naming the shape and the rule unless both numbers are positive and at most
  /// kMostStrataInLine, and for a hemicube rows = 3 columns with an even number of columns.
  Strata(Stratification stratification, GridShape shape);

  Stratification stratification() const { return stratification_; }
  GridShape shape() const { return shape_; }

  /// Unit direction, n component >= 0.
  Eigen::Vector3d direction(const StratumPosition& position) const;

  /// Inverse of `direction`. A direction on the border between strata belongs to either.
  StratumPosition position(const Eigen::Vector3d& direction) const;

  /// Where a direction is in one stratum or, if it is not there, the place on the stratum's border nearest to it, each
  /// coordinate of the grid by itself: to small distances at most twice as far away as the nearest.
  StratumPosition nearestPosition(std::size_t row, std::size_t column, const Eigen::Vector3d& direction) const;

  /// Integral of the cosine over the stratum; the sum over all is pi. sr.
  double projectedSolidAngle(std::size_t row, std::size_t column) const;

  /// sr; the sum over all is 2 pi.
  double solidAngle(std::size_t row, std::size_t column) const;

 private:
  Stratification stratification_;
  GridShape shape_;
};

}  // namespace irradiff
