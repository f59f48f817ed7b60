#include "derivatives/samples/concentric_strata.h"

#include "derivatives/samples/grid_coordinate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace irradiff {

namespace {

constexpr double kQuarterPi = std::numbers::pi / 4.0;

/// A border of strata on one axis of the square, at |a| = steps / count.
struct Border {
  std::size_t steps;
  std::size_t count;

  double value() const { return static_cast<double>(steps) / static_cast<double>(count); }
  double cosine() const {
    const auto all = static_cast<double>(count);
    return std::sqrt(static_cast<double>(count - steps) * static_cast<double>(count + steps)) / all;
  }
};

/// |a| of `q` less that of `p`, rounded once: numerators and denominators are whole numbers below 2^53.
double distance(const Border& p, const Border& q) {
  const double difference = static_cast<double>(q.steps * p.count) - static_cast<double>(p.steps * q.count);
  return difference / (static_cast<double>(p.count) * static_cast<double>(q.count));
}

/// A side of a stratum as an interval of |a|; a side that has 0 in its middle is twice that.
struct FoldedSide {
  Border low, high;
  double copies;
};

FoldedSide foldedSide(std::size_t index, std::size_t count) {
  const auto border = [count](std::size_t i) { return Border{2 * i > count ? 2 * i - count : count - 2 * i, count}; };
  if (2 * index + 1 == count) return {{0, count}, border(index), 2.0};
  return 2 * index >= count ? FoldedSide{border(index), border(index + 1), 1.0}
                            : FoldedSide{border(index + 1), border(index), 1.0};
}

/// asin q - asin p for p <= q, without cancellation.
double arcBetween(const Border& p, const Border& q) {
  const double cos_p = p.cosine();
  const double cos_q = q.cosine();
  // sin of the difference is q cos p - p cos q, and the squares of the two terms differ by q^2 - p^2.
  const double sine = distance(p, q) * (q.value() + p.value()) / (q.value() * cos_p + p.value() * cos_q);
  return std::atan2(sine, p.value() * q.value() + cos_p * cos_q);
}

/// x - sin x for 0 <= x <= pi/2, by its series.
double angleMinusSine(double x) {
  const double square = x * x;
  double sum = 1.0;
  // The last term left out is x^25 / 25! < 6e-21.
  for (int k = 22; k >= 4; k -= 2) sum = 1.0 - square / static_cast<double>(k * (k + 1)) * sum;
  return x * square / 6.0 * sum;
}

}  // namespace

Eigen::Vector3d concentricDirection(const GridShape& shape, const StratumPosition& position) {
  const GridCoordinate along_t = gridCoordinate({position.column, position.along_row}, shape.columns);
  const GridCoordinate along_b = gridCoordinate({position.row, position.along_column}, shape.rows);
  const bool is_t_longer = std::abs(along_t.centred) >= std::abs(along_b.centred);
  const GridCoordinate& longer = is_t_longer ? along_t : along_b;
  const double radius = longer.centred;
  if (radius == 0.0) return {0.0, 0.0, 1.0};
  const double angle = kQuarterPi * ((is_t_longer ? along_b : along_t).centred / radius);
  // 1 - |radius| from the nearer end of the grid keeps its digits at the horizon.
  const double to_rim = 2.0 * std::min(longer.from_start, longer.from_end);
  const double height = std::sqrt(to_rim * (1.0 + std::abs(radius)));
  const double main = radius * std::cos(angle);
  const double across = radius * std::sin(angle);
  return is_t_longer ? Eigen::Vector3d(main, across, height) : Eigen::Vector3d(across, main, height);
}

StratumPosition concentricPosition(const GridShape& shape, const Eigen::Vector3d& direction) {
  const double t = direction.x();
  const double b = direction.y();
  const double sine_squared = t * t + b * b;
  const double cosine_squared = direction.z() * direction.z();
  const double all = sine_squared + cosine_squared;
  const double radius = std::sqrt(sine_squared / all);
  const double to_rim = cosine_squared / all / (1.0 + radius);
  const bool is_t_longer = std::abs(t) >= std::abs(b);
  const double main = is_t_longer ? t : b;
  const double across = is_t_longer ? b : t;
  const std::size_t main_count = is_t_longer ? shape.columns : shape.rows;
  const std::size_t across_count = is_t_longer ? shape.rows : shape.columns;
  const GridCell main_cell = main < 0.0 ? gridCell(to_rim / 2.0, (1.0 + radius) / 2.0, main_count)
                                        : gridCell((1.0 + radius) / 2.0, to_rim / 2.0, main_count);
  // From -1 to 1 between the diagonals; any at the pole.
  const double fraction = main == 0.0 ? 0.0 : std::atan(across / main) / kQuarterPi;
  const GridCell across_cell = gridCell(std::copysign(radius, main) * fraction, across_count);
  const GridCell& column = is_t_longer ? main_cell : across_cell;
  const GridCell& row = is_t_longer ? across_cell : main_cell;
  return {row.index, column.index, column.along, row.along};
}

StratumPosition concentricNearestPosition(const GridShape& shape, std::size_t row, std::size_t column,
                                          const Eigen::Vector3d& direction) {
  const StratumPosition p = concentricPosition(shape, direction);
  return {row, column, nearestAlong(column, GridCell{p.column, p.along_row}),
          nearestAlong(row, GridCell{p.row, p.along_column})};
}

// The map has the constant Jacobian pi/4 to the disk, and the cosine depends on m = max(|a|, |b|) alone. So the solid
// angle is pi/4 times the integral over m of l(m) / sqrt(1 - m^2), l(m) being the length of the stratum's part of the
// square's outline |a|, |b| <= m. From the first m that meets the stratum on, l is the length of one side; if the
// stratum meets the diagonal, first 2 (m - p) + 2 p - a0 - b0 from p = max(a0, b0) to min(a1, b1).
double concentricSolidAngle(const GridShape& shape, std::size_t row, std::size_t column) {
  const FoldedSide a = foldedSide(column, shape.columns);
  const FoldedSide b = foldedSide(row, shape.rows);
  const double lows_apart = distance(a.low, b.low);
  const Border& start = lows_apart <= 0.0 ? a.low : b.low;
  const bool a_ends_first = distance(a.high, b.high) >= 0.0;
  const Border& middle = a_ends_first ? a.high : b.high;
  const Border& end = a_ends_first ? b.high : a.high;
  const bool meets_diagonal = distance(start, middle) > 0.0;
  double integral = 0.0;
  if (meets_diagonal) {
    const double arc = arcBetween(start, middle);
    // The integral of 2 (m - p) / sqrt(1 - m^2): with m = sin s, of 2 (sin s - sin s_p).
    const double half_sine = std::sin(arc / 2.0);
    integral += 2.0 * (start.cosine() * 2.0 * half_sine * half_sine - start.value() * angleMinusSine(arc));
    integral += std::abs(lows_apart) * arc;
  }
  const Border& from = meets_diagonal ? middle : start;
  if (distance(from, end) > 0.0) {
    const FoldedSide& side = a_ends_first ? a : b;
    integral += distance(side.low, side.high) * arcBetween(from, end);
  }
  return kQuarterPi * a.copies * b.copies * integral;
}

}  // namespace irradiff
