// Wall vectors against the motion of the walls' points, and against the divergence theorem.

#include "derivatives/estimators/strata_walls.h"

#include "derivatives/boundary/gauss_legendre.h"
#include "tests/estimators/sampled_scene.h"
#include "tests/estimators/wall_motion.h"
#include "verification/comparison/error_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;

std::vector<Strata> assortedStrata() {
  using enum Stratification;
  return {{kPolar, {1, 1}},       {kPolar, {1, 7}},      {kPolar, {5, 1}},      {kPolar, {3, 2}},
          {kPolar, {4, 12}},      {kConcentric, {1, 1}}, {kConcentric, {1, 6}}, {kConcentric, {7, 1}},
          {kConcentric, {2, 2}},  {kConcentric, {3, 3}}, {kConcentric, {8, 8}}, {kConcentric, {5, 8}},
          {kConcentric, {12, 3}}, {kHemicube, {6, 2}},   {kHemicube, {12, 4}},  {kHemicube, {18, 6}}};
}

/// A wall's vector out of the stratum at `row`, `column` across `side`, according to somebody.
using WallRule = std::function<Vector2d(const StrataWall& wall, const Strata& strata, std::size_t row,
                                        std::size_t column, std::size_t side)>;

/// Half the angle h of a column; h / sin h is what the published ring walls have too much.
double ringExcess(const GridShape& shape) {
  const double half_column = kPi / static_cast<double>(shape.columns);
  return half_column / std::sin(half_column);
}

/// The largest difference between a rule and the motion of the wall's points, in units of the error that the
/// differences have by their own account.
double worstDisagreement(const WallRule& rule) {
  double worst = 0.0;
  for (const Strata& strata : assortedStrata()) {
    const std::vector<StrataWall> walls = strataWalls(strata);
    std::size_t count = 0;
    forEachSharedSide(strata, [&](std::size_t, std::size_t, std::size_t row, std::size_t column, std::size_t side) {
      const StrataWall& wall = walls.at(count++);
      const bool is_polar = strata.stratification() == Stratification::kPolar;
      const auto motion = [&](std::size_t pieces) {
        const Vector2d left = sweptProjectedSolidAngle(sidePoints(strata, stratumSide(row, column, side), pieces));
        // The polar grid, rows outward, is a mirror image.
        return Vector2d(is_polar ? -left : left);
      };
      constexpr std::size_t kPieces = 420;  // of 3, 4, 5 and 7: the folds of the concentric map are between pieces
      const Vector2d fine = motion(2 * kPieces);
      const std::vector<Eigen::Vector3d> ends = sidePoints(strata, stratumSide(row, column, side), 1);
      // Second order: the finer of two resolutions is off by a third of their difference, and the step of 2e-5 by its
      // square times a third derivative, less than 100 times the length.
      double own_error = (fine - motion(kPieces)).norm() + 4e-8 * (ends[1] - ends[0]).norm();
      Vector2d expected = fine;
      if (is_polar && side % 2 == 1) {
        // A ring that is closed in one column has no mean direction; the published one then points at the middle.
        if (strata.shape().columns == 1) return;
        expected *= ringExcess(strata.shape());
        own_error *= ringExcess(strata.shape());
      }
      worst = std::max(worst, (rule(wall, strata, row, column, side) - expected).norm() / own_error);
    });
    EXPECT_EQ(count, walls.size());
  }
  return worst;
}

Vector2d asBuilt(const StrataWall& wall, const Strata&, std::size_t, std::size_t, std::size_t) { return wall.vector; }

TEST(StrataWalls, MoveAsTheirPointsDo) {
  const double worst = worstDisagreement(asBuilt);
  std::cout << "largest difference from the motion of points, in units of its own error: " << worst << '\n';
  EXPECT_LE(worst, 1.0);
}

TEST(StrataWalls, MistakenVectorsAreCaught) {
  // The chord alone: a wall that moves with the same speed in the disk wherever it is.
  EXPECT_GT(worstDisagreement(
                [](const StrataWall&, const Strata& strata, std::size_t row, std::size_t column, std::size_t side) {
                  const StratumSide path = stratumSide(row, column, side);
                  const Eigen::Vector3d chord = strata.direction(path.end) - strata.direction(path.start);
                  const double sign = strata.stratification() == Stratification::kPolar ? -1.0 : 1.0;
                  return Vector2d(sign * chord.y(), -sign * chord.x());
                }),
            100.0);
  EXPECT_GT(worstDisagreement([](const StrataWall& wall, const Strata&, std::size_t, std::size_t, std::size_t) {
              return Vector2d(-wall.vector);
            }),
            100.0);
  EXPECT_GT(worstDisagreement([](const StrataWall& wall, const Strata&, std::size_t, std::size_t, std::size_t side) {
              return Vector2d((side == 1 ? 1.001 : 1.0) * wall.vector);
            }),
            10.0);
  // The innermost ring skipped.
  EXPECT_GT(worstDisagreement(
                [](const StrataWall& wall, const Strata& strata, std::size_t row, std::size_t, std::size_t side) {
                  const bool is_innermost = strata.stratification() == Stratification::kPolar && row == 0 && side == 1;
                  return Vector2d((is_innermost ? 0.0 : 1.0) * wall.vector);
                }),
            100.0);
}

/// Integral of X over the projection of a stratum on the disk, which the concentric map folds at no place inside.
Vector2d firstMoment(const Strata& strata, std::size_t row, std::size_t column) {
  const GaussLegendreRule& rule = gaussLegendre(16);
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const Eigen::Vector3d w = strata.direction({row, column, rule.nodes[i], rule.nodes[j]});
      sum += rule.weights[i] * rule.weights[j] * w.head<2>();
    }
  }
  return strata.projectedSolidAngle(row, column) * sum;
}

/// What the walls of a stratum add up to, outwards, by the divergence theorem: the divergence of the vector field whose
/// flux (mu - (mu.X) X) is along any constant vector is -3 X.
TEST(StrataWalls, OfAConcentricStratumAddUpToItsFirstMoment) {
  ErrorStatistics statistics;
  for (const std::size_t n : {5u, 16u, 64u}) {
    const Strata strata(Stratification::kConcentric, {n, n});
    std::vector<Vector2d> sums(n * n, Vector2d::Zero());
    for (const StrataWall& wall : strataWalls(strata)) {
      sums[wall.first] += wall.vector;
      sums[wall.second] -= wall.vector;
    }
    for (std::size_t row = 1; row + 1 < n; ++row) {
      for (std::size_t column = 1; column + 1 < n; ++column) {
        // Strata on the folds are left out: the rule does not integrate them.
        if (row == column || row + column + 1 == n) continue;
        const Vector2d expected = -3.0 * firstMoment(strata, row, column);
        statistics.add((sums[row * n + column] - expected).norm(), row * n + column);
      }
    }
  }
  std::cout << "divergence theorem: peak error " << statistics.peak() << ", RMS " << statistics.rootMeanSquare()
            << " over " << statistics.count() << " strata\n";
  // Four walls, each the difference of coordinates below 1 and of an integral of about 10 roundings.
  EXPECT_LE(statistics.peak(), 4.0 * 12.0 * 0x1p-53);
}

/// The vectors of walls between rows, added up along a coarse stratum's side.
std::vector<Vector2d> rowWalls(const GridShape& shape, const GridShape& coarse) {
  std::vector<Vector2d> sums(coarse.size(), Vector2d::Zero());
  for (const StrataWall& wall : strataWalls({Stratification::kConcentric, shape})) {
    const std::size_t row = wall.first / shape.columns;
    if (wall.second != wall.first + shape.columns || (row + 1) % (shape.rows / coarse.rows) != 0) continue;
    const std::size_t column = wall.first % shape.columns / (shape.columns / coarse.columns);
    sums[row / (shape.rows / coarse.rows) * coarse.columns + column] += wall.vector;
  }
  return sums;
}

/// A long wall, which the folds of the map cut and on which the radius varies a hundredfold, is the sum of its parts.
TEST(StrataWalls, OfLongConcentricStrataAreTheSumsOfTheirParts) {
  const GridShape coarse{201, 2};
  const std::size_t parts = 64;
  const std::vector<Vector2d> whole = rowWalls(coarse, coarse);
  const std::vector<Vector2d> sums = rowWalls({coarse.rows, parts * coarse.columns}, coarse);
  double worst = 0.0;
  for (std::size_t i = 0; i < whole.size(); ++i) worst = std::max(worst, (whole[i] - sums[i]).norm());
  std::cout << "walls against the sums of their parts: " << worst << '\n';
  // Each part is right to a few roundings of coordinates below 1.
  EXPECT_LE(worst, static_cast<double>(parts) * 4.0 * 0x1p-53);
}

TEST(StrataWalls, EveryNeighbourhoodIsMutual) {
  for (const Strata& strata : assortedStrata()) {
    const GridShape shape = strata.shape();
    std::multiset<std::pair<std::size_t, std::size_t>> sides;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      for (const std::size_t neighbour : stratumNeighbours(strata, i / shape.columns, i % shape.columns)) {
        if (neighbour != kNoStratum) sides.emplace(i, neighbour);
      }
    }
    for (const auto& [from, to] : sides) {
      EXPECT_NE(from, to);
      EXPECT_EQ(sides.count({from, to}), sides.count({to, from}));
    }
  }
}

/// A step outwards from a side, as far as a step inwards would be, ends in the neighbour.
TEST(StrataWalls, NeighboursAreBeyondTheSides) {
  for (const Strata& strata : assortedStrata()) {
    const GridShape shape = strata.shape();
    forEachSharedSide(
        strata, [&](std::size_t first, std::size_t second, std::size_t row, std::size_t column, std::size_t side) {
          const StratumSide path = stratumSide(row, column, side);
          StratumPosition on_side{row, column, 0.7 * path.start.along_row + 0.3 * path.end.along_row,
                                  0.7 * path.start.along_column + 0.3 * path.end.along_column};
          StratumPosition inside = on_side;
          double& across = side % 2 == 0 ? inside.along_row : inside.along_column;
          across = side < 2 ? 1.0 - 1e-4 : 1e-4;
          const Eigen::Vector3d outwards = 2.0 * strata.direction(on_side) - strata.direction(inside);
          const StratumPosition outside = strata.position(outwards.normalized());
          const std::size_t found = outside.row * shape.columns + outside.column;
          EXPECT_EQ(found, second) << "stratum " << first << " side " << side << " of a " << shape.rows << " x "
                                   << shape.columns << " grid";
        });
  }
}

TEST(StrataWalls, CountAndSizeOfTheTable) {
  EXPECT_EQ(strataWalls({Stratification::kPolar, {4, 12}}).size(), 3u * 12 + 4 * 12);
  EXPECT_EQ(strataWalls({Stratification::kConcentric, {8, 5}}).size(), 7u * 5 + 8 * 4);
  // Twelve texels of the band and the top face, each with four sides, but for the eight at the horizon.
  EXPECT_EQ(strataWalls({Stratification::kHemicube, {6, 2}}).size(), (12u * 4 - 8) / 2);
  EXPECT_TRUE(strataWalls({Stratification::kPolar, {1, 1}}).empty());
  EXPECT_EQ(sizeof(StrataWall), 24u);
}

}  // namespace
}  // namespace irradiff
