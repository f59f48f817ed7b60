// The maps between grids of strata and directions: where strata are, what they weigh, and the way back. Each check runs
// on a wrong map, too, and must refuse it.

#include "derivatives/samples/strata.h"

#include "tests/samples/outline_area.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kPi = std::numbers::pi;
constexpr double kUnitRoundoff = 0x1p-53;

/// What the checks ask of Strata, so that they can be asked of something wrong.
struct Candidate {
  GridShape shape;
  DirectionMap direction;
  std::function<StratumPosition(const Vector3d&)> position;
  std::function<double(std::size_t row, std::size_t column)> projected_solid_angle;
  std::function<double(std::size_t row, std::size_t column)> solid_angle;
};

Candidate candidate(Stratification stratification, GridShape shape) {
  const Strata strata(stratification, shape);
  return {shape, [strata](const StratumPosition& p) { return strata.direction(p); },
          [strata](const Vector3d& d) { return strata.position(d); },
          [strata](std::size_t row, std::size_t column) { return strata.projectedSolidAngle(row, column); },
          [strata](std::size_t row, std::size_t column) { return strata.solidAngle(row, column); }};
}

struct Grid {
  Stratification stratification;
  GridShape shape;
};

std::vector<Grid> grids() {
  using enum Stratification;
  return {{kPolar, {1, 1}},      {kPolar, {1, 4}},      {kPolar, {8, 25}},       {kPolar, {64, 64}},
          {kConcentric, {1, 1}}, {kConcentric, {2, 2}}, {kConcentric, {3, 3}},   {kConcentric, {5, 8}},
          {kConcentric, {9, 2}}, {kConcentric, {1, 6}}, {kConcentric, {33, 33}}, {kConcentric, {64, 64}},
          {kHemicube, {6, 2}},   {kHemicube, {12, 4}},  {kHemicube, {18, 6}},    {kHemicube, {96, 32}}};
}

std::string nameOf(const Grid& grid) {
  const std::string kind = grid.stratification == Stratification::kPolar        ? "polar "
                           : grid.stratification == Stratification::kConcentric ? "concentric "
                                                                                : "hemicube ";
  return kind + std::to_string(grid.shape.rows) + " x " + std::to_string(grid.shape.columns);
}

StratumPosition randomPosition(const GridShape& shape, double margin, std::mt19937_64& random) {
  std::uniform_int_distribution<std::size_t> row(0, shape.rows - 1), column(0, shape.columns - 1);
  std::uniform_real_distribution<double> along(margin, 1.0 - margin);
  return {row(random), column(random), along(random), along(random)};
}

// ---------------------------------------------------------------------------------------------------- where they are

/// A stratum's middle and where it must be.
struct KnownDirection {
  std::size_t row, column;
  Vector3d toward;  ///< of any length
};

double worstAngle(const DirectionMap& map, const std::vector<KnownDirection>& known) {
  double worst = 0.0;
  for (const KnownDirection& k : known) {
    worst = std::max(worst, (map({k.row, k.column, 0.5, 0.5}) - k.toward.normalized()).norm());
  }
  return worst;
}

constexpr double kKnownDirectionError = 16 * kUnitRoundoff;

TEST(Strata, OfPolarGridsRunOutwardAndCounterclockwise) {
  const Strata strata(Stratification::kPolar, {2, 4});
  const double s = std::numbers::sqrt2 / 2.0;
  const double low = std::sqrt(3.0);
  // Rings around sin^2 = 1/4 and 3/4; azimuths of 45, 135, 225 and 315 degrees.
  const std::vector<KnownDirection> known = {{0, 0, {s, s, low}},  {0, 1, {-s, s, low}},    {0, 2, {-s, -s, low}},
                                             {0, 3, {s, -s, low}}, {1, 0, {s, s, 1 / low}}, {1, 3, {s, -s, 1 / low}}};
  const DirectionMap right = [&strata](const StratumPosition& p) { return strata.direction(p); };
  EXPECT_LE(worstAngle(right, known), kKnownDirectionError);
  const DirectionMap clockwise = [&](const StratumPosition& p) -> Vector3d {
    return strata.direction(p).cwiseProduct(Vector3d(1, -1, 1));
  };
  const DirectionMap inward = [&](const StratumPosition& p) {
    return strata.direction({1 - p.row, p.column, p.along_row, 1 - p.along_column});
  };
  EXPECT_GT(worstAngle(clockwise, known), 0.1);
  EXPECT_GT(worstAngle(inward, known), 0.1);
}

TEST(Strata, OfPolarGridsStartAtTheTangent) {
  const Strata strata(Stratification::kPolar, {1, 8});
  const double n = std::sqrt(0.5);
  EXPECT_EQ(strata.direction({0, 0, 0.0, 0.5}), Vector3d(n, 0, n));
  EXPECT_EQ(strata.direction({0, 2, 0.0, 0.5}), Vector3d(0, n, n));
  EXPECT_EQ(strata.direction({0, 4, 0.0, 0.5}), Vector3d(-n, 0, n));
  EXPECT_EQ(strata.direction({0, 6, 0.0, 0.5}), Vector3d(0, -n, n));
}

TEST(Strata, OfConcentricGridsRunAlongTheTangents) {
  const Strata strata(Stratification::kConcentric, {3, 3});
  const double n = std::sqrt(5.0) / 3.0;
  const double d = std::numbers::sqrt2 / 3.0;
  const double r = 2.0 / 3.0;
  const std::vector<KnownDirection> known = {{1, 1, {0, 0, 1}},  {1, 2, {r, 0, n}},   {2, 1, {0, r, n}},
                                             {1, 0, {-r, 0, n}}, {0, 1, {0, -r, n}},  {2, 2, {d, d, n}},
                                             {2, 0, {-d, d, n}}, {0, 0, {-d, -d, n}}, {0, 2, {d, -d, n}}};
  const DirectionMap right = [&strata](const StratumPosition& p) { return strata.direction(p); };
  EXPECT_LE(worstAngle(right, known), kKnownDirectionError);
  const DirectionMap transposed = [&](const StratumPosition& p) {
    return strata.direction({p.column, p.row, p.along_column, p.along_row});
  };
  const DirectionMap downward = [&](const StratumPosition& p) {
    return strata.direction({2 - p.row, p.column, p.along_row, 1 - p.along_column});
  };
  EXPECT_GT(worstAngle(transposed, known), 0.1);
  EXPECT_GT(worstAngle(downward, known), 0.1);
}

TEST(Strata, OfHemicubesGoAroundFromTheTopFace) {
  const Strata strata(Stratification::kHemicube, {12, 4});
  const double h = 0.75;
  const double q = 0.25;
  const std::vector<KnownDirection> known = {{0, 0, {-h, -h, 1}},  {0, 3, {h, -h, 1}},  {3, 0, {-h, h, 1}},
                                             {2, 1, {-q, q, 1}},                                               // top
                                             {4, 0, {1, -h, q}},   {4, 3, {1, h, q}},   {5, 0, {1, -h, h}},    // +t
                                             {6, 0, {h, 1, q}},    {6, 3, {-h, 1, q}},  {7, 0, {h, 1, h}},     // +b
                                             {8, 0, {-1, h, q}},   {8, 3, {-1, -h, q}}, {9, 1, {-1, q, h}},    // -t
                                             {10, 0, {-h, -1, q}}, {10, 3, {h, -1, q}}, {11, 2, {q, -1, h}}};  // -b
  const DirectionMap right = [&strata](const StratumPosition& p) { return strata.direction(p); };
  EXPECT_LE(worstAngle(right, known), kKnownDirectionError);
  const DirectionMap from_the_top_down = [&](const StratumPosition& p) {
    if (p.row < 4) return strata.direction(p);
    return strata.direction({p.row % 2 == 0 ? p.row + 1 : p.row - 1, p.column, p.along_row, 1 - p.along_column});
  };
  const DirectionMap clockwise = [&](const StratumPosition& p) {
    if (p.row < 4) return strata.direction(p);
    return strata.direction({p.row, 3 - p.column, 1 - p.along_row, p.along_column});
  };
  const DirectionMap faces_in_another_order = [&](const StratumPosition& p) {
    const std::size_t row = p.row < 6 || p.row > 9 ? p.row : p.row < 8 ? p.row + 2 : p.row - 2;
    return strata.direction({row, p.column, p.along_row, p.along_column});
  };
  EXPECT_GT(worstAngle(from_the_top_down, known), 0.1);
  EXPECT_GT(worstAngle(clockwise, known), 0.1);
  EXPECT_GT(worstAngle(faces_in_another_order, known), 0.1);
}

TEST(Strata, CoverTheHemisphereToItsRim) {
  for (const Grid& grid : grids()) {
    const Strata strata(grid.stratification, grid.shape);
    for (const double along_row : {0.0, 0.25, 1.0}) {
      for (const double along_column : {0.0, 0.25, 1.0}) {
        for (std::size_t row = 0; row < grid.shape.rows; ++row) {
          for (std::size_t column = 0; column < grid.shape.columns; ++column) {
            const Vector3d d = strata.direction({row, column, along_row, along_column});
            ASSERT_TRUE(d.allFinite() && d.z() >= 0.0) << nameOf(grid) << ": " << d.transpose();
          }
        }
      }
    }
  }
  const auto height = [](Stratification s, GridShape shape, const StratumPosition& p) {
    return Strata(s, shape).direction(p).z();
  };
  EXPECT_EQ(height(Stratification::kPolar, {3, 5}, {2, 1, 0.3, 1.0}), 0.0);
  EXPECT_EQ(height(Stratification::kConcentric, {3, 5}, {1, 4, 1.0, 0.3}), 0.0);
  EXPECT_EQ(height(Stratification::kHemicube, {12, 4}, {8, 1, 0.3, 0.0}), 0.0);
}

// -------------------------------------------------------------------------------------------------------- the way back

/// The first of `count` random positions that does not come back; empty if all do. Next to the pole the azimuth has
/// 1 / sin of the polar angle as many roundings.
std::string failedRoundTrip(const Candidate& map, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const StratumPosition p = randomPosition(map.shape, 1e-3, random);
    const Vector3d d = map.direction(p);
    const StratumPosition back = map.position(d);
    const double strata = static_cast<double>(std::max(map.shape.rows, map.shape.columns));
    const double tolerance = 32 * kUnitRoundoff * strata / d.head<2>().norm();
    const bool is_same = back.row == p.row && back.column == p.column &&
                         std::abs(back.along_row - p.along_row) <= tolerance &&
                         std::abs(back.along_column - p.along_column) <= tolerance;
    if (!is_same) {
      return "(" + std::to_string(p.row) + " + " + std::to_string(p.along_column) + ", " + std::to_string(p.column) +
             " + " + std::to_string(p.along_row) + ") came back as (" + std::to_string(back.row) + " + " +
             std::to_string(back.along_column) + ", " + std::to_string(back.column) + " + " +
             std::to_string(back.along_row) + ")";
    }
  }
  return "";
}

TEST(Strata, FindThePositionThatADirectionCameFrom) {
  std::uint64_t seed = 20261126;
  for (const Grid& grid : grids()) {
    EXPECT_EQ(failedRoundTrip(candidate(grid.stratification, grid.shape), 20000, ++seed), "") << nameOf(grid);
  }
}

TEST(Strata, AWrongWayBackIsNoticed) {
  for (const Stratification stratification :
       {Stratification::kPolar, Stratification::kConcentric, Stratification::kHemicube}) {
    Candidate wrong = candidate(stratification, {24, 8});
    const auto right = wrong.position;
    wrong.position = [right](const Vector3d& d) {
      StratumPosition p = right(d);
      std::swap(p.along_row, p.along_column);
      return p;
    };
    EXPECT_NE(failedRoundTrip(wrong, 20000, 1), "");
    wrong.position = [right](const Vector3d& d) { return right({d.x(), d.y(), d.z() * (1 + 1e-13)}); };
    EXPECT_NE(failedRoundTrip(wrong, 20000, 1), "");
  }
}

TEST(Strata, DirectionsOnBordersBelongToANeighbour) {
  std::mt19937_64 random(7);
  for (const Grid& grid : grids()) {
    const Strata strata(grid.stratification, grid.shape);
    double worst = 0.0;
    for (std::size_t i = 0; i < 20000; ++i) {
      StratumPosition p = randomPosition(grid.shape, 0.0, random);
      p.along_row = i % 2 == 0 ? 0.0 : std::ldexp(p.along_row, -static_cast<int>(i % 100));
      p.along_column = i % 3 == 0 ? 1.0 : std::ldexp(p.along_column, -static_cast<int>(i % 70));
      const Vector3d d = strata.direction(p);
      const StratumPosition found = strata.position(d);
      ASSERT_LT(found.row, grid.shape.rows) << nameOf(grid);
      ASSERT_LT(found.column, grid.shape.columns) << nameOf(grid);
      for (const double along : {found.along_row, found.along_column}) ASSERT_TRUE(along >= 0 && along <= 1) << along;
      const Vector3d again = strata.direction(found);
      // A place next to 1 is known to a rounding of 1, and so is n^2.
      worst = std::max({worst, (again - d).head<2>().norm(), std::abs(again.z() * again.z() - d.z() * d.z())});
    }
    EXPECT_LE(worst, 48 * kUnitRoundoff) << nameOf(grid);
  }
}

using NearestPosition = std::function<StratumPosition(std::size_t row, std::size_t column, const Vector3d&)>;

/// How far the nearest place in a stratum is at worst from directions that are a nudge away from one in it, in nudges.
double worstNearest(const Strata& strata, const NearestPosition& nearest) {
  constexpr double kNudge = 1e-7;
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  double worst = 0.0;
  for (std::size_t i = 0; i < 20000; ++i) {
    StratumPosition p = randomPosition(strata.shape(), 0.0, random);
    // On every border in turn, often the first and the last of the grid.
    if (i % 2 == 0) p.along_row = i % 4 == 0 ? 0.0 : 1.0;
    if (i % 3 != 0) p.along_column = i % 3 == 1 ? 0.0 : 1.0;
    if (i % 5 == 0) p.column = i % 10 == 0 ? 0 : strata.shape().columns - 1;
    const Vector3d nudge(normal(random), normal(random), normal(random));
    Vector3d d = (strata.direction(p) + kNudge * nudge.normalized()).normalized();
    if (d.z() < 0.0) d.z() = -d.z();
    const StratumPosition q = nearest(p.row, p.column, d);
    const bool is_inside = q.row == p.row && q.column == p.column && q.along_row >= 0.0 && q.along_row <= 1.0 &&
                           q.along_column >= 0.0 && q.along_column <= 1.0;
    if (!is_inside) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, (strata.direction(q) - d).norm() / kNudge);
  }
  return worst;
}

TEST(Strata, FindTheNearestPlaceInAStratum) {
  for (const Grid& grid : grids()) {
    const Strata strata(grid.stratification, grid.shape);
    const double worst = worstNearest(strata, [&](std::size_t row, std::size_t column, const Vector3d& d) {
      return strata.nearestPosition(row, column, d);
    });
    std::cout << nameOf(grid) << ": at worst " << worst << " nudges away\n";
    // Coordinate by coordinate: no farther than twice the nearest, which is at most one nudge away.
    EXPECT_LE(worst, 2.0) << nameOf(grid);
  }
}

TEST(Strata, FindADirectionWhereItIs) {
  std::mt19937_64 random(18);
  for (const Grid& grid : grids()) {
    const Strata strata(grid.stratification, grid.shape);
    for (int i = 0; i < 2000; ++i) {
      const StratumPosition p = randomPosition(grid.shape, 1e-3, random);
      const Vector3d d = strata.direction(p);
      const StratumPosition found = strata.nearestPosition(p.row, p.column, d);
      // The stretch of a map is largest at the horizon: n^2 is linear in the grid.
      EXPECT_LE((strata.direction(found) - d).norm(), 64 * kUnitRoundoff / d.z()) << nameOf(grid);
    }
  }
}

TEST(Strata, ANearestPlaceThatForgetsTheNeighboursIsNoticed) {
  // Polar azimuths without the seam between the last column and the first; the other maps without their folds.
  for (const auto& [stratification, shape] :
       std::vector<Grid>{{Stratification::kPolar, {8, 25}}, {Stratification::kHemicube, {12, 4}}}) {
    const Strata strata(stratification, shape);
    const double worst = worstNearest(strata, [&strata](std::size_t row, std::size_t column, const Vector3d& d) {
      const StratumPosition p = strata.position(d);
      const auto clamped = [](std::size_t from, double along, std::size_t to) {
        return std::clamp(static_cast<double>(from) + along - static_cast<double>(to), 0.0, 1.0);
      };
      return StratumPosition{row, column, clamped(p.column, p.along_row, column), clamped(p.row, p.along_column, row)};
    });
    EXPECT_GT(worst, 1000.0);
  }
}

// ------------------------------------------------------------------------------------------------------------- weights

/// Relative; strata_accuracy_test.cpp finds at most 9 u.
constexpr double kWeightError = 24 * kUnitRoundoff;

/// What the nodes' own errors of 20 u (strata_accuracy_test.cpp) make of an area: 20 u times the outline's length, at
/// most 4 pi in the disk and in the azimuth.
constexpr double kOutlineRounding = 20 * kUnitRoundoff * 4 * kPi;

/// How far the weights of random blocks of strata are from the areas that the images of their outlines enclose,
/// relative to the outline's own uncertainty: at most 1 if they agree.
double worstWeight(const Candidate& map, double sign, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  double worst = 0.0;
  for (int trial = 0; trial < 30; ++trial) {
    const auto interval = [&random](std::size_t low, std::size_t high) {
      std::uniform_int_distribution<std::size_t> end(low, high - 1);
      const std::size_t a = end(random), b = end(random);
      return std::pair(std::min(a, b), std::max(a, b) + 1);
    };
    const auto [column, column_end] = interval(0, map.shape.columns);
    const auto [row, row_end] = interval(0, map.shape.rows);
    long double projected = 0.0L;
    long double solid = 0.0L;
    for (std::size_t i = row; i < row_end; ++i) {
      for (std::size_t j = column; j < column_end; ++j) {
        projected += map.projected_solid_angle(i, j);
        solid += map.solid_angle(i, j);
      }
    }
    const OutlineAreas outline = outlineAreas(map.direction, map.shape,
                                              {static_cast<double>(column), static_cast<double>(column_end),
                                               static_cast<double>(row), static_cast<double>(row_end)});
    const auto compare = [&](long double sum, const MeasuredArea& area) {
      const auto weight = static_cast<double>(sum);
      const double uncertainty = area.change + kOutlineRounding + kWeightError * weight;
      if (!(uncertainty < 1e-4 * weight)) worst = std::numeric_limits<double>::infinity();
      worst = std::max(worst, std::abs(weight - sign * area.value) / uncertainty);
    };
    compare(projected, outline.projected_solid_angle);
    compare(solid, outline.solid_angle);
  }
  return worst;
}

// From the first corner along the columns and then the rows the outline runs counterclockwise, but for polar strata,
// whose rows go outward while their columns turn left.
double outlineSign(Stratification stratification) { return stratification == Stratification::kPolar ? -1.0 : 1.0; }

/// The strata in `rows` rows from `first` on: a face of a hemicube.
Candidate partOf(const Candidate& map, std::size_t first, std::size_t rows) {
  return {{rows, map.shape.columns},
          [=](const StratumPosition& p) {
            return map.direction({first + p.row, p.column, p.along_row, p.along_column});
          },
          nullptr,
          [=](std::size_t row, std::size_t column) { return map.projected_solid_angle(first + row, column); },
          [=](std::size_t row, std::size_t column) { return map.solid_angle(first + row, column); }};
}

TEST(Strata, WeighWhatTheirOutlinesEnclose) {
  std::uint64_t seed = 100;
  for (const Grid& grid : grids()) {
    const Candidate map = candidate(grid.stratification, grid.shape);
    if (grid.stratification != Stratification::kHemicube) {
      EXPECT_LE(worstWeight(map, outlineSign(grid.stratification), ++seed), 1.0) << nameOf(grid);
      continue;
    }
    const std::size_t n = grid.shape.columns;
    EXPECT_LE(worstWeight(partOf(map, 0, n), 1.0, ++seed), 1.0) << nameOf(grid) << ", top face";
    for (std::size_t face = 0; face < 4; ++face) {
      EXPECT_LE(worstWeight(partOf(map, n + face * n / 2, n / 2), 1.0, ++seed), 1.0)
          << nameOf(grid) << ", half face " << face;
    }
  }
}

TEST(Strata, AWrongWeightIsNoticed) {
  using enum Stratification;
  Candidate equal = candidate(kConcentric, {8, 8});
  equal.solid_angle = [](std::size_t, std::size_t) { return 2.0 * kPi / 64.0; };
  EXPECT_GT(worstWeight(equal, 1.0, 1), 100.0);
  Candidate texels = candidate(kHemicube, {24, 8});
  texels.projected_solid_angle = [](std::size_t row, std::size_t column) {
    // The cosine at the middle times the solid angle: nearly right.
    const Strata strata(kHemicube, {24, 8});
    return strata.solidAngle(row, column) * strata.direction({row, column}).z();
  };
  EXPECT_GT(worstWeight(partOf(texels, 0, 8), 1.0, 1), 100.0);
}

/// Whether rectangles of any place and size have their share of pi, as strata of equal projected solid angle need.
double worstShare(const DirectionMap& map, const GridShape& shape, double sign, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    const double columns = static_cast<double>(shape.columns), rows = static_cast<double>(shape.rows);
    const double c0 = 0.7 * unit(random), c1 = c0 + 0.05 + 0.25 * unit(random);
    const double r0 = 0.7 * unit(random), r1 = r0 + 0.05 + 0.25 * unit(random);
    const MeasuredArea area =
        outlineAreas(map, shape, {c0 * columns, c1 * columns, r0 * rows, r1 * rows}).projected_solid_angle;
    const double share = kPi * (c1 - c0) * (r1 - r0);
    const double uncertainty = area.change + kOutlineRounding;
    if (!(uncertainty < 1e-4 * share)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(sign * area.value - share) / uncertainty);
  }
  return worst;
}

TEST(Strata, PolarAndConcentricGridsPreserveArea) {
  std::uint64_t seed = 200;
  for (const Grid& grid : grids()) {
    if (grid.stratification == Stratification::kHemicube) continue;
    const Strata strata(grid.stratification, grid.shape);
    const DirectionMap map = [&strata](const StratumPosition& p) { return strata.direction(p); };
    EXPECT_LE(worstShare(map, grid.shape, outlineSign(grid.stratification), ++seed), 1.0) << nameOf(grid);
  }
}

TEST(Strata, AMapThatDoesNotPreserveAreaIsNoticed) {
  const Strata polar(Stratification::kPolar, {8, 8});
  // Uniform in the solid angle instead: n = 1 - v.
  const DirectionMap uniform = [&polar](const StratumPosition& p) -> Vector3d {
    const Vector3d d = polar.direction(p);
    const double n = d.z() * d.z();
    return {d.x() * std::sqrt(1 + n), d.y() * std::sqrt(1 + n), n};
  };
  EXPECT_GT(worstShare(uniform, {8, 8}, -1.0, 1), 100.0);
  // The square stretched to the disk along its radii.
  const DirectionMap stretched = [](const StratumPosition& p) -> Vector3d {
    const double a = (static_cast<double>(p.column) + p.along_row) / 4.0 - 1.0;
    const double b = (static_cast<double>(p.row) + p.along_column) / 4.0 - 1.0;
    const double length = std::hypot(a, b);
    const double scale = length == 0.0 ? 1.0 : std::max(std::abs(a), std::abs(b)) / length;
    return {a * scale, b * scale, std::sqrt(std::max(0.0, 1.0 - scale * scale * length * length))};
  };
  EXPECT_GT(worstShare(stretched, {8, 8}, 1.0, 1), 100.0);
}

TEST(Strata, WeighPiAndTwoPiTogether) {
  std::vector<Grid> all = grids();
  all.push_back({Stratification::kHemicube, {1536, 512}});
  all.push_back({Stratification::kConcentric, {511, 256}});
  for (const Grid& grid : all) {
    const Strata strata(grid.stratification, grid.shape);
    long double projected = 0.0L;
    long double solid = 0.0L;
    for (std::size_t row = 0; row < grid.shape.rows; ++row) {
      for (std::size_t column = 0; column < grid.shape.columns; ++column) {
        projected += strata.projectedSolidAngle(row, column);
        solid += strata.solidAngle(row, column);
      }
    }
    EXPECT_NEAR(static_cast<double>(projected), kPi, kWeightError * kPi) << nameOf(grid);
    EXPECT_NEAR(static_cast<double>(solid), 2 * kPi, kWeightError * 2 * kPi) << nameOf(grid);
  }
}

// ---------------------------------------------------------------------------------------------------------- wrong
// calls

auto makes(Stratification stratification, GridShape shape) {
  return [=] { Strata(stratification, shape); };
}

TEST(Strata, RefuseWrongShapesByTheirNumbersAndTheRule) {
  using enum Stratification;
  EXPECT_THAT(makes(kPolar, {0, 4}),
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("shape 0 x 4"), HasSubstr("from 1 to 65536 rows"))));
  EXPECT_THAT(makes(kConcentric, {4, 0}), ThrowsMessage<std::invalid_argument>(HasSubstr("shape 4 x 0")));
  EXPECT_THAT(makes(kConcentric, {65537, 1}), ThrowsMessage<std::invalid_argument>(HasSubstr("shape 65537 x 1")));
  EXPECT_THAT(makes(kHemicube, {9, 3}), ThrowsMessage<std::invalid_argument>(
                                            AllOf(HasSubstr("shape 9 x 3"), HasSubstr("n even for a hemicube"))));
  EXPECT_THAT(makes(kHemicube, {4, 4}), ThrowsMessage<std::invalid_argument>(HasSubstr("3 n rows by n columns")));
  EXPECT_THAT(makes(kHemicube, {65538, 21846}), ThrowsMessage<std::invalid_argument>(HasSubstr("65538 x 21846")));
  EXPECT_NO_THROW(makes(kHemicube, {65532, 21844})());
  EXPECT_NO_THROW(makes(kConcentric, {65536, 65536})());
  EXPECT_NO_THROW(makes(kPolar, {1, 1})());
}

}  // namespace
}  // namespace irradiff
