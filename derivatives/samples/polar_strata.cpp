#include "derivatives/samples/polar_strata.h"

#include "derivatives/samples/grid_coordinate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace irradiff {

namespace {

constexpr double kPi = std::numbers::pi;

/// (cos, sin) of `cell` out of `count` equal parts of a turn. The angle is counted from the nearest axis, so that
/// directions on an axis are there exactly.
Eigen::Vector2d unitCircle(const GridCell& cell, std::size_t count) {
  const double quarters = 4.0 * gridCoordinate(cell, count).from_start;
  const double nearest = std::round(quarters);
  const double angle = (quarters - nearest) * (kPi / 2.0);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  switch (static_cast<int>(nearest) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace

Eigen::Vector3d polarDirection(const GridShape& shape, const StratumPosition& position) {
  const GridCoordinate sine_squared = gridCoordinate({position.row, position.along_column}, shape.rows);
  const Eigen::Vector2d azimuth = unitCircle({position.column, position.along_row}, shape.columns);
  const double sine = std::sqrt(sine_squared.from_start);
  return {sine * azimuth.x(), sine * azimuth.y(), std::sqrt(sine_squared.from_end)};
}

StratumPosition polarPosition(const GridShape& shape, const Eigen::Vector3d& direction) {
  const double sine_squared = direction.head<2>().squaredNorm();
  const double cosine_squared = direction.z() * direction.z();
  const double all = sine_squared + cosine_squared;
  const GridCell ring = gridCell(sine_squared / all, cosine_squared / all, shape.rows);
  // From -1/2 to 1/2 of a turn; below 0 it is counted from the end.
  const double turns = std::atan2(direction.y(), direction.x()) / (2.0 * kPi);
  const GridCell sector =
      turns >= 0.0 ? gridCell(turns, 1.0 - turns, shape.columns) : gridCell(1.0 + turns, -turns, shape.columns);
  return {ring.index, sector.index, sector.along, ring.along};
}

StratumPosition polarNearestPosition(const GridShape& shape, std::size_t row, std::size_t column,
                                     const Eigen::Vector3d& direction) {
  const StratumPosition p = polarPosition(shape, direction);
  const double along_column = nearestAlong(row, GridCell{p.row, p.along_column});
  if (p.column == column) return {row, column, p.along_row, along_column};
  // The shorter way round from the middle of the stratum.
  const auto turn = static_cast<double>(shape.columns);
  const double from_middle = static_cast<double>(p.column) + p.along_row - static_cast<double>(column) - 0.5;
  const double shorter = from_middle - turn * std::round(from_middle / turn);
  return {row, column, std::clamp(shorter + 0.5, 0.0, 1.0), along_column};
}

double polarSolidAngle(const GridShape& shape, std::size_t row) {
  const double inner = std::sqrt(gridCoordinate({row, 0.0}, shape.rows).from_end);
  const double outer = std::sqrt(gridCoordinate({row, 1.0}, shape.rows).from_end);
  // inner - outer, without cancellation: their squares differ by 1 / rows.
  return 2.0 * kPi / static_cast<double>(shape.size()) / (inner + outer);
}

}  // namespace irradiff
