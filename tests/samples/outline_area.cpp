#include "tests/samples/outline_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace irradiff {

namespace {

struct Areas {
  long double projected;
  long double solid;
};

struct GridPoint {
  double column, row;
};

GridPoint between(const GridPoint& from, const GridPoint& to, double s) {
  return {from.column + s * (to.column - from.column), from.row + s * (to.row - from.row)};
}

Eigen::Vector3d directionAt(const DirectionMap& map, const GridShape& shape, const GridPoint& point) {
  const auto cell = [](double coordinate, std::size_t count) {
    return std::min(static_cast<std::size_t>(coordinate), count - 1);
  };
  const std::size_t i = cell(point.column, shape.columns);
  const std::size_t j = cell(point.row, shape.rows);
  return map({j, i, point.column - static_cast<double>(i), point.row - static_cast<double>(j)});
}

/// Where a straight line between two points crosses the diagonals of the grid, from 0 to 1, with both ends.
std::vector<double> cutAtDiagonals(const GridShape& shape, const GridPoint& from, const GridPoint& to) {
  const auto along = [&shape](const GridPoint& p, double sign) {
    return 2.0 * p.column / static_cast<double>(shape.columns) - 1.0 +
           sign * (2.0 * p.row / static_cast<double>(shape.rows) - 1.0);
  };
  std::vector<double> cuts = {0.0, 1.0};
  for (const double sign : {-1.0, 1.0}) {
    const double at_from = along(from, sign);
    const double at_to = along(to, sign);
    if (at_from * at_to < 0.0) cuts.push_back(at_from / (at_from - at_to));
  }
  std::ranges::sort(cuts);
  return cuts;
}

Areas areasOfPolyline(const std::vector<Eigen::Vector3d>& points) {
  Areas areas{0.0L, 0.0L};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Matrix<long double, 3, 1> p = points[k].cast<long double>();
    const Eigen::Matrix<long double, 3, 1> q = points[(k + 1) % points.size()].cast<long double>();
    const long double cross = p.x() * q.y() - p.y() * q.x();
    areas.projected += cross / 2.0L;
    areas.solid += (1.0L - (p.z() + q.z()) / 2.0L) * std::atan2(cross, p.x() * q.x() + p.y() * q.y());
  }
  return areas;
}

Areas areas(const DirectionMap& map, const GridShape& shape, const GridRectangle& r, std::size_t nodes_on_piece) {
  const std::array<GridPoint, 4> corners = {
      {{r.column_low, r.row_low}, {r.column_high, r.row_low}, {r.column_high, r.row_high}, {r.column_low, r.row_high}}};
  std::vector<Eigen::Vector3d> points;
  for (std::size_t side = 0; side < 4; ++side) {
    const GridPoint& from = corners[side];
    const GridPoint& to = corners[(side + 1) % 4];
    const std::vector<double> cuts = cutAtDiagonals(shape, from, to);
    for (std::size_t piece = 0; piece + 1 < cuts.size(); ++piece) {
      for (std::size_t k = 0; k < nodes_on_piece; ++k) {
        // Nodes that crowd at both ends, where the outline may meet the horizon at a right angle.
        const double x = static_cast<double>(k) / static_cast<double>(nodes_on_piece);
        const double s = cuts[piece] + x * x * (3.0 - 2.0 * x) * (cuts[piece + 1] - cuts[piece]);
        points.push_back(directionAt(map, shape, between(from, to, s)));
      }
    }
  }
  return areasOfPolyline(points);
}

}  // namespace

OutlineAreas outlineAreas(const DirectionMap& map, const GridShape& shape, const GridRectangle& rectangle) {
  constexpr std::size_t kNodesOnPiece = 1000;
  const Areas coarse = areas(map, shape, rectangle, kNodesOnPiece);
  const Areas fine = areas(map, shape, rectangle, 2 * kNodesOnPiece);
  const auto measured = [](long double value, long double half_as_many) {
    return MeasuredArea{static_cast<double>(value), static_cast<double>(std::abs(value - half_as_many))};
  };
  return {measured(fine.projected, coarse.projected), measured(fine.solid, coarse.solid)};
}

}  // namespace irradiff
