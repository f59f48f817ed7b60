#include "derivatives/scene/simple_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Outline = std::vector<Vector2d>;

// The oracle: every pair of edges in integer arithmetic, from the definition.
struct GridPoint {
  std::int64_t x, y;
  bool operator==(const GridPoint&) const = default;
};

std::int64_t side(GridPoint a, GridPoint b, GridPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool onSegment(GridPoint a, GridPoint b, GridPoint p) {
  return side(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool edgesMeet(const std::vector<GridPoint>& points, std::size_t i, std::size_t j) {
  const std::size_t n = points.size();
  const GridPoint a = points[i], b = points[(i + 1) % n], c = points[j], d = points[(j + 1) % n];
  // Neighbours meet twice only if the end of one is on the other.
  if ((i + 1) % n == j) return onSegment(a, b, d) || onSegment(c, d, a);
  if ((j + 1) % n == i) return onSegment(c, d, b) || onSegment(a, b, c);
  if (onSegment(a, b, c) || onSegment(a, b, d) || onSegment(c, d, a) || onSegment(c, d, b)) return true;
  const auto opposite = [](std::int64_t s, std::int64_t t) { return (s > 0 && t < 0) || (s < 0 && t > 0); };
  return opposite(side(a, b, c), side(a, b, d)) && opposite(side(c, d, a), side(c, d, b));
}

bool anyEdgesMeet(const std::vector<GridPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (edgesMeet(points, i, j)) return true;
    }
  }
  return false;
}

// On a coarse grid touching, overlapping, vertical and collinear edges are the rule.
TEST(MeetingEdges, AgreesWithEveryPairInIntegerArithmetic) {
  std::mt19937 random(7);
  std::array<int, 2> verdicts{};
  for (int trial = 0; trial < 60000; ++trial) {
    const std::int64_t grid = 2 + trial % 5;
    const std::size_t count = 3 + random() % 7;
    std::vector<GridPoint> points;
    while (points.size() < std::min(count, static_cast<std::size_t>((grid + 1) * (grid + 1)))) {
      const GridPoint point{static_cast<std::int64_t>(random() % static_cast<unsigned>(grid + 1)),
                            static_cast<std::int64_t>(random() % static_cast<unsigned>(grid + 1))};
      if (std::ranges::find(points, point) == points.end()) points.push_back(point);
    }
    Outline outline;
    for (const GridPoint& point : points) {
      outline.emplace_back(static_cast<double>(point.x), static_cast<double>(point.y));
    }
    const auto meeting = meetingEdges(outline);
    const bool expected = anyEdgesMeet(points);
    ASSERT_EQ(meeting.has_value(), expected) << "trial " << trial;
    if (meeting) {
      ASSERT_LT(meeting->first, meeting->second);
      ASSERT_TRUE(edgesMeet(points, meeting->first, meeting->second)) << "trial " << trial;
    }
    ++verdicts[expected];
  }
  EXPECT_GT(verdicts[0], 1000) << "too few simple polygons to show anything";
  EXPECT_GT(verdicts[1], 1000) << "too few self-intersecting polygons to show anything";
}

// A star around the origin: simple whatever its radii.
Outline star(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> radius(0.1, 1);
  Outline outline;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    outline.push_back(radius(random) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

TEST(MeetingEdges, AcceptsAStarOfAHundredThousandVerticesAndFindsTheOneCrossing) {
  std::mt19937 random(11);
  Outline outline = star(100000, random);
  for (std::size_t i = 54319; i < 54323; ++i) outline[i].normalize();
  EXPECT_FALSE(meetingEdges(outline));
  // Two neighbours on a circle that change places make the edges to their other neighbours cross.
  std::swap(outline[54320], outline[54321]);
  const auto meeting = meetingEdges(outline);
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->first, 54319);
  EXPECT_EQ(meeting->second, 54321);
}

// Every edge is as long as the polygon, the worst case for a test by overlapping intervals.
TEST(MeetingEdges, AcceptsACombOfAHundredThousandLongTeeth) {
  Outline comb;
  for (int tooth = 0; tooth < 50000; ++tooth) {
    comb.emplace_back(0, tooth);
    comb.emplace_back(1e6, tooth + 0.5);
  }
  comb.emplace_back(-1, 50000);
  comb.emplace_back(-1, -1);
  EXPECT_FALSE(meetingEdges(comb));
  comb[50001].x() = -0.5;  // the tip of one tooth comes out at the back, where nothing is
  EXPECT_FALSE(meetingEdges(comb));
  comb[50001].x() = -1;  // and now it touches the back
  EXPECT_TRUE(meetingEdges(comb));
}

}  // namespace
}  // namespace irradiff
