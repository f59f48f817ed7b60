#include "derivatives/scene/triangulation.h"

#include "derivatives/scene/simple_polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using Triangle = std::array<std::size_t, 3>;
__extension__ using Wide = __int128;

// The oracle works on integers, in which areas are exact: coordinates below 2^51.
struct GridPoint {
  std::int64_t x, y;
  bool operator==(const GridPoint&) const = default;
};
using Outline = std::vector<GridPoint>;

Wide twiceArea(GridPoint a, GridPoint b, GridPoint c) {
  return Wide{b.x - a.x} * Wide{c.y - a.y} - Wide{b.y - a.y} * Wide{c.x - a.x};
}

Wide twiceArea(const Outline& outline) {
  Wide sum = 0;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) sum += twiceArea(outline[0], outline[i], outline[i + 1]);
  return sum;
}

int sign(Wide value) { return (value > 0) - (value < 0); }

using DirectedEdge = std::pair<std::size_t, std::size_t>;

// The edges of the triangles less those that two triangles run through in opposite directions. Where all triangles
// turn the same way and this is the polygon's boundary, a point of the plane is in as many of them as the boundary
// winds about it: one inside, none outside. So they cover the polygon without overlaps.
std::multiset<DirectedEdge> boundaryOf(const std::vector<Triangle>& triangles) {
  std::multiset<DirectedEdge> boundary;
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const DirectedEdge edge{triangle[i], triangle[(i + 1) % 3]};
      if (const auto reverse = boundary.find({edge.second, edge.first}); reverse != boundary.end()) {
        boundary.erase(reverse);
      } else {
        boundary.insert(edge);
      }
    }
  }
  return boundary;
}

// What is wrong with the triangles of a simple polygon, or nothing.
std::string flawOf(const std::vector<Triangle>& triangles, const Outline& outline) {
  if (triangles.size() != outline.size() - 2) return "not n - 2 triangles";
  const Wide whole = twiceArea(outline);
  Wide sum = 0;
  for (const auto& [a, b, c] : triangles) {
    if (std::max({a, b, c}) >= outline.size()) return "no such vertex";
    const Wide part = twiceArea(outline[a], outline[b], outline[c]);
    if (part == 0) return "a triangle without an area";
    if (sign(part) != sign(whole)) return "a triangle turns against the polygon";
    sum += part;
  }
  if (sum != whole) return "the areas do not sum to the polygon's";
  std::multiset<DirectedEdge> edges;
  for (std::size_t i = 0; i < outline.size(); ++i) edges.insert({i, (i + 1) % outline.size()});
  if (boundaryOf(triangles) != edges) return "the triangles' boundary is not the polygon's";
  return "";
}

TEST(FlawOf, RejectsEveryWayToBeWrong) {
  // A square with a vertex in the middle of its lower edge, and a notch (vertex 4) in its upper one.
  const Outline outline{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  EXPECT_THAT(flawOf({{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 5}}, outline), IsEmpty());
  EXPECT_THAT(flawOf({{0, 1, 4}, {1, 2, 4}, {2, 3, 4}}, outline), HasSubstr("n - 2"));
  EXPECT_THAT(flawOf({{0, 1, 2}, {0, 2, 4}, {2, 3, 4}, {0, 4, 5}}, outline), HasSubstr("without an area"));
  EXPECT_THAT(flawOf({{0, 4, 1}, {1, 2, 4}, {2, 3, 4}, {0, 4, 5}}, outline), HasSubstr("against the polygon"));
  EXPECT_THAT(flawOf({{0, 1, 5}, {1, 2, 3}, {1, 3, 5}, {3, 4, 5}}, outline), HasSubstr("against the polygon"));
  EXPECT_THAT(flawOf({{0, 1, 4}, {0, 1, 4}, {2, 3, 4}, {0, 4, 6}}, outline), HasSubstr("no such vertex"));
  EXPECT_THAT(flawOf({{0, 1, 4}, {0, 1, 5}, {2, 3, 4}, {0, 4, 5}}, outline), HasSubstr("do not sum"));
  // The two halves of the lower triangle are one of them twice: the areas are right.
  EXPECT_THAT(flawOf({{0, 1, 4}, {0, 1, 4}, {2, 3, 4}, {0, 4, 5}}, outline), HasSubstr("boundary"));
}

// How the plane of the outline lies in space; each way is exact for coordinates up to 2^51.
enum class Placement { kFlat, kSteep, kScaled };

Polygon polygonOf(const Outline& outline, Placement placement) {
  Polygon polygon{"outline", {}, 1.0};
  for (const GridPoint& point : outline) {
    const auto x = static_cast<double>(point.x);
    const auto y = static_cast<double>(point.y);
    switch (placement) {
      case Placement::kFlat:
        polygon.vertices.emplace_back(x, y, 0.0);
        break;
      // z and x are kept.
      case Placement::kSteep:
        polygon.vertices.emplace_back(y, 4 * y, x);
        break;
      case Placement::kScaled:
        polygon.vertices.emplace_back(7.0, std::ldexp(x, 900), std::ldexp(y, -900));
        break;
    }
  }
  return polygon;
}

Outline reversed(Outline outline) {
  std::ranges::reverse(outline);
  return outline;
}

// The vertex that the numbers start at decides nothing but the numbers.
Outline rotated(Outline outline, std::size_t first) {
  std::ranges::rotate(outline, outline.begin() + static_cast<std::ptrdiff_t>(first % outline.size()));
  return outline;
}

std::vector<Eigen::Vector2d> inDoubles(const Outline& outline) {
  std::vector<Eigen::Vector2d> plane;
  for (const GridPoint& point : outline) plane.emplace_back(static_cast<double>(point.x), static_cast<double>(point.y));
  return plane;
}

bool isSimple(const Outline& outline) { return twiceArea(outline) != 0 && !meetingEdges(inDoubles(outline)); }

void expectTriangulated(const Outline& outline) {
  ASSERT_TRUE(isSimple(outline));
  for (const Outline& turned : {outline, reversed(outline), rotated(outline, outline.size() / 3)}) {
    for (const Placement placement : {Placement::kFlat, Placement::kSteep, Placement::kScaled}) {
      const Polygon polygon = polygonOf(turned, placement);
      const std::vector<Triangle> triangles = triangulate(polygon);
      EXPECT_THAT(flawOf(triangles, turned), IsEmpty()) << "placement " << static_cast<int>(placement);
      EXPECT_EQ(triangulate(polygon), triangles) << "not the same twice";
    }
  }
}

// Every edge cut into `pieces`.
Outline subdivided(const Outline& outline, std::int64_t pieces) {
  Outline fine;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const GridPoint a = outline[i];
    const GridPoint b = outline[(i + 1) % outline.size()];
    for (std::int64_t k = 0; k < pieces; ++k) {
      fine.push_back({pieces * a.x + k * (b.x - a.x), pieces * a.y + k * (b.y - a.y)});
    }
  }
  return fine;
}

Outline comb(std::int64_t teeth) {
  Outline outline{{0, -1}};
  for (std::int64_t tooth = 0; tooth < teeth; ++tooth) {
    outline.push_back({2 * tooth + 1, 1'000'000});
    outline.push_back({2 * tooth + 2, 0});
  }
  outline.push_back({2 * teeth, -1});
  return outline;
}

// Right angles only: a wall 2 thick along a path that turns left after every side, its turns 4 apart.
Outline squareSpiral(std::int64_t sides) {
  Outline left;
  Outline right;
  GridPoint corner{0, 0};
  GridPoint along{1, 0};
  GridPoint normal_before{0, 0};
  for (std::int64_t side = 0; side <= sides; ++side) {
    const GridPoint normal = side == sides ? GridPoint{0, 0} : GridPoint{-along.y, along.x};
    const GridPoint offset{normal_before.x + normal.x, normal_before.y + normal.y};
    left.push_back({corner.x + offset.x, corner.y + offset.y});
    right.push_back({corner.x - offset.x, corner.y - offset.y});
    const std::int64_t length = 4 * (side / 2 + 1);
    corner = {corner.x + length * along.x, corner.y + length * along.y};
    along = {-along.y, along.x};
    normal_before = normal;
  }
  right.insert(right.end(), left.rbegin(), left.rend());
  return right;
}

// Radii in [radius/10, radius], rounded to the grid: simple where the angle between neighbours is far above rounding.
Outline star(std::size_t count, std::mt19937& random) {
  constexpr double kRadius = 0x1p50;
  std::uniform_real_distribution<double> radius(0.1 * kRadius, kRadius);
  Outline outline;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = radius(random);
    outline.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
  }
  return outline;
}

// An arm that winds about the origin, `steps` vertices on either side.
Outline roundSpiral(std::size_t steps, double windings) {
  Outline outline;
  Outline back;
  for (std::size_t i = 0; i < steps; ++i) {
    const double along = static_cast<double>(i) / static_cast<double>(steps);
    const double angle = 2 * std::numbers::pi * windings * along;
    for (auto& [side, radius] : {std::pair{&outline, 1.0 + windings * along}, {&back, 1.4 + windings * along}}) {
      side->push_back(
          {std::llround(0x1p40 * radius * std::cos(angle)), std::llround(0x1p40 * radius * std::sin(angle))});
    }
  }
  outline.insert(outline.end(), back.rbegin(), back.rend());
  return outline;
}

TEST(Triangulate, CoversShapesThatWindAndBranch) {
  std::mt19937 random(3);
  for (const auto& [name, outline] :
       std::vector<std::pair<std::string, Outline>>{{"triangle", {{0, 0}, {5, 1}, {2, 7}}},
                                                    {"convex quadrilateral", {{0, 0}, {5, 1}, {6, 6}, {1, 5}}},
                                                    {"dart", {{0, 0}, {5, 5}, {10, 0}, {5, 9}}},
                                                    {"comb", comb(40)},
                                                    {"square spiral", squareSpiral(3)},
                                                    {"long square spiral", squareSpiral(50)},
                                                    {"round spiral", roundSpiral(150, 6)},
                                                    {"star", star(200, random)}}) {
    SCOPED_TRACE(name);
    expectTriangulated(outline);
  }
}

TEST(Triangulate, LeavesNoTriangleWithoutAnAreaWhereVerticesAreOnOneLine) {
  // Only the last vertex sees the others.
  Outline fan;
  for (std::int64_t i = 0; i < 20; ++i) fan.push_back({i, 0});
  fan.push_back({3, 1});
  expectTriangulated(fan);
  for (const std::int64_t pieces : {2, 3, 7}) {
    SCOPED_TRACE(pieces);
    expectTriangulated(subdivided({{0, 0}, {5, 1}, {2, 7}}, pieces));
    expectTriangulated(subdivided({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, pieces));
    expectTriangulated(subdivided(comb(6), pieces));
    expectTriangulated(subdivided(squareSpiral(9), pieces));
  }
}

// On a coarse grid vertices above each other, rows on one line and vertices in line with far edges are the rule.
TEST(Triangulate, CoversRandomPolygonsOnACoarseGrid) {
  std::mt19937 random(20240611);
  int simple = 0;
  int with_rows = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    std::uniform_int_distribution<std::int64_t> coordinate(0, 2 + trial % 5);
    Outline outline;
    const std::size_t count = 3 + random() % 6;
    while (outline.size() < count) {
      const GridPoint point{coordinate(random), coordinate(random)};
      if (std::ranges::find(outline, point) == outline.end()) outline.push_back(point);
    }
    if (!isSimple(outline)) continue;
    ++simple;
    for (std::size_t i = 0; i < count; ++i) {
      if (twiceArea(outline[i], outline[(i + 1) % count], outline[(i + 2) % count]) == 0) {
        ++with_rows;
        break;
      }
    }
    expectTriangulated(outline);
    ASSERT_FALSE(HasFailure()) << "trial " << trial;
  }
  EXPECT_GT(simple, 3000) << "too few simple polygons to show anything";
  EXPECT_GT(with_rows, 500) << "too few rows on one line to show anything";
}

// Vertices are put into edges wherever the polygon stays simple: all shapes come out, with rows on one line.
TEST(Triangulate, CoversPolygonsGrownAtRandom) {
  std::mt19937 random(99);
  std::size_t largest = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::int64_t grid = trial % 2 == 0 ? 12 : 1'000'000'000;
    std::uniform_int_distribution<std::int64_t> coordinate(0, grid);
    Outline outline{{0, 0}, {grid, 0}, {grid, grid}};
    for (int attempt = 0; attempt < 600; ++attempt) {
      const GridPoint point{coordinate(random), coordinate(random)};
      if (std::ranges::find(outline, point) != outline.end()) continue;
      Outline grown = outline;
      grown.insert(grown.begin() + static_cast<std::ptrdiff_t>(random() % (outline.size() + 1)), point);
      if (isSimple(grown)) outline = grown;
    }
    largest = std::max(largest, outline.size());
    expectTriangulated(outline);
    ASSERT_FALSE(HasFailure()) << "trial " << trial;
  }
  EXPECT_GT(largest, 50U);
}

// Sides that are parallel but for the last bit: rounding would decide them at random.
TEST(Triangulate, IsExactWhereVerticesMissALineByOneUnit) {
  constexpr std::int64_t kFar = std::int64_t{1} << 50;
  for (std::int64_t nudge : {-1, 0, 1}) {
    SCOPED_TRACE(nudge);
    // The middle vertices of a long side, on it or beside it.
    Outline outline{{0, 0}, {kFar / 4, kFar / 4 + nudge}, {kFar / 2, kFar / 2}, {kFar, kFar}, {-kFar, kFar - 3}};
    expectTriangulated(outline);
    // A sliver one unit wide, its two sides cut at different places.
    outline = {{0, 0}, {kFar / 3, kFar / 3}, {kFar, kFar}, {kFar / 2, kFar / 2 + 1}, {kFar / 5, kFar / 5 + 2 + nudge}};
    expectTriangulated(outline);
  }
}

TEST(Triangulate, TakesWellUnderASecondForTwentyThousandVertices) {
  std::mt19937 random(5);
  for (const auto& [name, outline] :
       std::vector<std::pair<std::string, Outline>>{{"star", star(20000, random)},
                                                    {"comb", comb(10000)},
                                                    {"square spiral", squareSpiral(10000)},
                                                    {"round spiral", roundSpiral(10000, 100)},
                                                    {"row", subdivided({{0, 0}, {5, 1}, {2, 7}}, 6667)}}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(isSimple(outline));
    ASSERT_GE(outline.size(), 20000U);
    const Polygon polygon = polygonOf(outline, Placement::kFlat);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Triangle> triangles = triangulate(polygon);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    EXPECT_THAT(flawOf(triangles, outline), IsEmpty());
    EXPECT_LT(elapsed.count(), 0.5);
    RecordProperty("milliseconds for " + name, std::to_string(1e3 * elapsed.count()));
  }
}

}  // namespace
}  // namespace irradiff
