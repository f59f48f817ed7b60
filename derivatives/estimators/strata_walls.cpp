#include "derivatives/estimators/strata_walls.h"

#include "derivatives/boundary/gauss_legendre.h"
#include "derivatives/estimators/texel_wall.h"
#include "derivatives/samples/stratum_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace irradiff {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kQuarterPi = kPi / 4.0;

/// Out of the stratum across a side of a ring or a column.
//   Ring: u_k (2 pi / N) sin theta cos^2 theta; spoke: v_k- (sin theta_+ - sin theta_-)
// Ward and Heckbert 1992, the translation gradient.
Eigen::Vector2d polarWall(const GridShape& shape, std::size_t row, std::size_t column, std::size_t side) {
  const auto rings = static_cast<double>(shape.rows);
  const double column_angle = 2.0 * kPi / static_cast<double>(shape.columns);
  const double outwards = side < 2 ? 1.0 : -1.0;
  if (side % 2 == 1) {
    const auto ring = static_cast<double>(side == 1 ? row + 1 : row);
    const double sine = std::sqrt(ring / rings);
    const double cosine_squared = (rings - ring) / rings;
    const double middle = (static_cast<double>(column) + 0.5) * column_angle;
    return outwards * column_angle * sine * cosine_squared * Eigen::Vector2d(std::cos(middle), std::sin(middle));
  }
  const double azimuth = static_cast<double>(side == 0 ? column + 1 : column) * column_angle;
  const auto ring = static_cast<double>(row);
  // sin theta_+ - sin theta_-, whose squares differ by 1 / M.
  const double length = 1.0 / (rings * (std::sqrt((ring + 1.0) / rings) + std::sqrt(ring / rings)));
  return outwards * length * Eigen::Vector2d(-std::sin(azimuth), std::cos(azimuth));
}

/// Walls of the concentric map have one coordinate of the square fixed, the other moving, and X = (along the axis of
/// the fixed one, along that of the moving one).
/// The integral of X r^2 dphi along a part of a wall on which |moving| <= |fixed|: an arc of radius |fixed|.
Eigen::Vector2d arcMoment(double fixed, double start, double end) {
  const double start_angle = kQuarterPi * (start / fixed);
  const double end_angle = kQuarterPi * (end / fixed);
  return fixed * fixed * fixed *
         Eigen::Vector2d(std::sin(end_angle) - std::sin(start_angle), std::cos(start_angle) - std::cos(end_angle));
}

/// The same where moving > |fixed|: a spiral of radius `moving`, on which r^2 dphi = pi/4 fixed d(moving).
Eigen::Vector2d spiralMoment(double fixed, double start, double end) {
  // The integrand is analytic but for the centre. With that as far away as the length, 16 nodes are exact to rounding;
  // ten times as far, 6.
  const GaussLegendreRule& rule = gaussLegendre(10.0 * (end - start) <= start ? 6 : 16);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double radius = start + (end - start) * rule.nodes[i];
    const double angle = kQuarterPi * (fixed / radius);
    sum += rule.weights[i] * radius * Eigen::Vector2d(std::sin(angle), std::cos(angle));
  }
  return kQuarterPi * fixed * (end - start) * sum;
}

/// The same for |fixed| <= start < end, in parts that at most double the radius.
Eigen::Vector2d spiralMomentInParts(double fixed, double start, double end) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  if (fixed == 0.0) return sum;
  while (start < end) {
    const double inner = std::max(start, end / 2.0);
    sum += spiralMoment(fixed, inner, end);
    end = inner;
  }
  return sum;
}

/// The integral of X r^2 dphi along a wall in the coordinates (fixed, moving), for start < end.
Eigen::Vector2d wallMoment(double fixed, double start, double end) {
  const double diagonal = std::abs(fixed);
  Eigen::Vector2d sum = spiralMomentInParts(fixed, std::max(start, diagonal), end);
  const Eigen::Vector2d mirrored = spiralMomentInParts(fixed, std::max(-end, diagonal), -start);
  sum += Eigen::Vector2d(mirrored.x(), -mirrored.y());
  const double arc_start = std::max(start, -diagonal);
  const double arc_end = std::min(end, diagonal);
  return arc_start < arc_end ? Eigen::Vector2d(sum + arcMoment(fixed, arc_start, arc_end)) : sum;
}

/// From `start` to `end` in either order.
Eigen::Vector2d directedMoment(double fixed, double start, double end) {
  return start < end ? wallMoment(fixed, start, end) : Eigen::Vector2d(-wallMoment(fixed, end, start));
}

/// -1 to 1 along an axis of the square.
double squareCoordinate(std::size_t index, double along, std::size_t count) {
  return (2.0 * static_cast<double>(index) - static_cast<double>(count) + 2.0 * along) / static_cast<double>(count);
}

/// Out of the stratum:
//   integral of (mu - (mu.X) X) dl = (dy, -dx) - integral of X r^2 dphi
// along the side with the stratum on its left: there mu dl = (dy, -dx) and mu.X dl = x dy - y dx = r^2 dphi.
Eigen::Vector2d concentricWall(const Strata& strata, const StratumSide& side) {
  const GridShape shape = strata.shape();
  const auto a = [&](const StratumPosition& p) { return squareCoordinate(p.column, p.along_row, shape.columns); };
  const auto b = [&](const StratumPosition& p) { return squareCoordinate(p.row, p.along_column, shape.rows); };
  const Eigen::Vector3d chord = strata.direction(side.end) - strata.direction(side.start);
  const Eigen::Vector2d turned_chord(chord.y(), -chord.x());
  if (side.start.along_row == side.end.along_row) {
    return turned_chord - directedMoment(a(side.start), b(side.start), b(side.end));
  }
  // The map commutes with exchanging the axes, which turns the sense of phi.
  const Eigen::Vector2d exchanged = directedMoment(b(side.start), a(side.start), a(side.end));
  return turned_chord + Eigen::Vector2d(exchanged.y(), exchanged.x());
}

Eigen::Vector2d wallVector(const Strata& strata, std::size_t row, std::size_t column, std::size_t side) {
  switch (strata.stratification()) {
    case Stratification::kPolar:
      return polarWall(strata.shape(), row, column, side);
    case Stratification::kConcentric:
      return concentricWall(strata, stratumSide(row, column, side));
    case Stratification::kHemicube:
      break;
  }
  const TexelWall wall = texelWall(strata, stratumSide(row, column, side));
  return wall.cosine_integral * wall.outer_normal.head<2>();
}

}  // namespace

std::vector<StrataWall> strataWalls(const Strata& strata) {
  std::vector<StrataWall> walls;
  walls.reserve(2 * strata.shape().size());
  forEachSharedSide(strata,
                    [&](std::size_t first, std::size_t second, std::size_t row, std::size_t column, std::size_t side) {
                      walls.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second),
                                       wallVector(strata, row, column, side)});
                    });
  return walls;
}

}  // namespace irradiff
