// The nearest of segments in a quarter plane, against a search at many directions.

#include "experiments/cache_3d/visible_slice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace irradiff {
namespace {

SliceSegment between(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  // inverse.p = inverse.q = 1.
  Eigen::Matrix2d rows;
  rows << p.transpose(), q.transpose();
  const auto u = [](const Eigen::Vector2d& v) { return v[0] * v[0] / v.squaredNorm(); };
  SliceSegment segment;
  segment.inverse = rows.inverse() * Eigen::Vector2d::Ones();
  segment.plane.setZero();
  segment.begin.u = std::min(u(p), u(q));
  segment.end.u = std::max(u(p), u(q));
  return segment;
}

std::size_t nearest(const std::vector<SliceSegment>& segments, double u) {
  std::size_t best = segments.size();
  double largest = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const double inverse = segments[i].inverse.dot(sliceDirection(u));
    if (u >= segments[i].begin.u && u <= segments[i].end.u && inverse > largest) {
      best = i;
      largest = inverse;
    }
  }
  return best;
}

std::size_t partAt(const std::vector<VisiblePart>& parts, double u, std::size_t none) {
  for (const VisiblePart& part : parts) {
    if (part.begin.u <= u && u <= part.end.u) return part.segment;
  }
  return none;
}

TEST(VisibleSlice, FindsTheNearestOfSegmentsThatCross) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(0.02, 3.0);
  std::size_t crossings = 0;
  for (int scene = 0; scene < 200; ++scene) {
    std::vector<SliceSegment> segments;
    for (int i = 0; i < 8; ++i) {
      segments.push_back(between({coordinate(random), coordinate(random)}, {coordinate(random), coordinate(random)}));
    }
    std::vector<VisiblePart> parts;
    findVisibleParts(segments, parts);
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
      EXPECT_LE(parts[k].end.u, parts[k + 1].begin.u);
      const double cut = parts[k].end.u;
      bool is_an_end = false;
      for (const SliceSegment& segment : segments) is_an_end |= segment.begin.u == cut || segment.end.u == cut;
      if (!is_an_end) ++crossings;
    }
    for (int k = 0; k < 200; ++k) {
      const double u = (k + 0.37) / 200.0;
      EXPECT_EQ(partAt(parts, u, segments.size()), nearest(segments, u)) << "scene " << scene << ", u " << u;
    }
  }
  EXPECT_GT(crossings, 100U) << "without crossings they are not tested";
}

TEST(VisibleSlice, LeavesWhereNothingIs) {
  std::vector<VisiblePart> parts;
  findVisibleParts({}, parts);
  EXPECT_TRUE(parts.empty());
  findVisibleParts({between({1, 2}, {2, 1}), between({0.1, 2}, {0.2, 2})}, parts);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].segment, 1U);
  EXPECT_EQ(parts[1].segment, 0U);
  EXPECT_LT(parts[0].end.u, parts[1].begin.u);
}

}  // namespace
}  // namespace irradiff
