#include "derivatives/estimators/jump_chain.h"
#include "derivatives/estimators/radiance_jump.h"
#include "derivatives/estimators/radiance_regions.h"
#include "derivatives/estimators/seen_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace irradiff {
namespace {

/// The edge from a to b of a surface with its inside on the side to which `inside` points, seen from the origin: jumps
/// of half width `half` at equal steps.
std::vector<RadianceJump> jumpsAlong(const Eigen::Vector3d& a, const Eigen::Vector3d& b, std::size_t count,
                                     double half) {
  const Eigen::Vector3d plane_normal = a.cross(b).normalized();
  std::vector<RadianceJump> jumps;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const Eigen::Vector3d p = (1.0 - t) * a + t * b;
    // Off centre by turns, as halvings leave it.
    const double shift = (i % 2 == 0 ? 0.4 : -0.4) * half;
    const Eigen::Vector3d w = p.normalized();
    const Eigen::Vector3d near = (w + (half + shift) * plane_normal).normalized();
    const Eigen::Vector3d far = (w - (half - shift) * plane_normal).normalized();
    jumps.push_back({{near, 1.0 / p.norm(), 2.0}, {far, 0.0, 0.0}, 2.0, 0.0});
  }
  return jumps;
}

std::vector<std::size_t> all(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

TEST(SeenLine, IsTheEdgeToWithinTheJumps) {
  const Eigen::Vector3d a(-1.0, 0.5, 2.0);
  const Eigen::Vector3d b(1.5, 0.8, 1.2);
  for (const double half : {1e-2, 1e-4, 1e-8}) {
    const std::vector<RadianceJump> jumps = jumpsAlong(a, b, 9, half);
    const auto line = fitLine(jumps, all(9));
    ASSERT_TRUE(line);
    EXPECT_LE(line->plane_normal.cross(a.cross(b).normalized()).norm(), half);
    EXPECT_TRUE(partsJumps(*line, jumps, all(9)));
    const Eigen::Vector3d middle = 0.5 * (a + b);
    EXPECT_NEAR(line->inverseDistance(middle.normalized()), 1.0 / middle.norm(), 2.0 * half);
    EXPECT_LE(line->edgeDirection().cross((b - a).normalized()).norm(), 8.0 * half);
  }
}

TEST(SeenLine, DoesNotPassJumpsThatItMisses) {
  std::vector<RadianceJump> jumps = jumpsAlong({-1.0, 0.5, 2.0}, {1.5, 0.8, 1.2}, 9, 1e-4);
  const auto line = fitLine(jumps, all(9));
  std::vector<RadianceJump> shifted = jumps;
  for (SeenPoint* seen : {&shifted[4].a, &shifted[4].b}) {
    seen->direction = (seen->direction + 1e-3 * line->plane_normal).normalized();
  }
  EXPECT_FALSE(partsJumps(*line, shifted, all(9)));
  std::vector<RadianceJump> deeper = jumps;
  deeper[4].a.inverse_distance *= 1.01;
  EXPECT_FALSE(partsJumps(*line, deeper, all(9)));
}

TEST(StraightRuns, PartAPolygonAtItsCorners) {
  const std::vector<Eigen::Vector3d> corners{{-1.0, -1.0, 2.0}, {1.0, -1.2, 2.0}, {1.3, 0.9, 2.0}, {-0.8, 1.0, 2.0}};
  JumpChain chain;
  chain.is_closed = true;
  std::vector<RadianceJump> jumps;
  for (std::size_t i = 0; i < 4; ++i) {
    for (const RadianceJump& jump : jumpsAlong(corners[i], corners[(i + 1) % 4], 5 + i, 1e-5)) jumps.push_back(jump);
  }
  // Begin in the middle of a side.
  for (std::size_t i = 0; i < jumps.size(); ++i) chain.jumps.push_back((i + 3) % jumps.size());
  const std::vector<StraightRun> runs = straightRuns(chain, jumps);
  ASSERT_EQ(runs.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const StraightRun& run = runs[i];
    const StraightRun& next = runs[(i + 1) % 4];
    ASSERT_TRUE(run.line && next.line);
    const auto corner = cornerBetween(lastEnd(run, jumps), firstEnd(next, jumps));
    ASSERT_TRUE(corner);
    double nearest = 1.0;
    for (const Eigen::Vector3d& c : corners) nearest = std::min(nearest, (*corner - c.normalized()).norm());
    EXPECT_LE(nearest, 1e-4);
  }
}

TEST(JumpChains, FollowLinksFromEndToEnd) {
  JumpGraph graph;
  graph.jumps.resize(7);
  graph.links = {{3, 1}, {1, 5}, {0, 2}, {2, 4}, {4, 0}};
  const std::vector<JumpChain> chains = jumpChains(graph);
  ASSERT_EQ(chains.size(), 3U);
  EXPECT_EQ(chains[0].jumps, (std::vector<std::size_t>{3, 1, 5}));
  EXPECT_FALSE(chains[0].is_closed);
  EXPECT_EQ(chains[1].jumps, (std::vector<std::size_t>{6}));
  EXPECT_EQ(chains[2].jumps.size(), 3U);
  EXPECT_TRUE(chains[2].is_closed);
}

Neighbours neighboursInARow(std::size_t count) {
  return [count](const NeighbourVisitor& visit) {
    for (std::size_t i = 0; i + 1 < count; ++i) visit(i, i + 1);
  };
}

TEST(RadianceRegions, AreTheRadianceItselfWhereItIsConstantByParts) {
  std::vector<double> radiance(8, 1.0);
  radiance.insert(radiance.end(), 8, 4.0);
  EXPECT_EQ(regionRadiance(radiance, neighboursInARow(16)), radiance);
}

TEST(RadianceRegions, PartSmoothRadianceAtItsJump) {
  const std::vector<double> radiance{1.0, 1.1, 1.2, 4.0, 4.1, 4.2, 4.3};
  const std::vector<double> region = regionRadiance(radiance, neighboursInARow(7));
  EXPECT_DOUBLE_EQ(region[0], 1.1);
  EXPECT_DOUBLE_EQ(region[2], 1.1);
  EXPECT_DOUBLE_EQ(region[3], 4.15);
  EXPECT_DOUBLE_EQ(region[6], 4.15);
  // Without a jump all is one region.
  const std::vector<double> smooth{1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6};
  EXPECT_DOUBLE_EQ(regionRadiance(smooth, neighboursInARow(7))[0], 1.3);
  // What is dark alike does not make small differences elsewhere stand out.
  const std::vector<double> half_dark{0.0, 0.0, 0.0, 0.0, 1.0, 1.01, 1.03, 1.06, 1.1};
  EXPECT_DOUBLE_EQ(regionRadiance(half_dark, neighboursInARow(9))[7], 5.2 / 5.0);
  EXPECT_EQ(regionRadiance(half_dark, neighboursInARow(9))[3], 0.0);
}

// Few rays see what varies, most are alike: four neighbours around a cell that differ, in rows of 6.
TEST(RadianceRegions, DoNotCountRaysThatAreAlike) {
  constexpr std::size_t kSide = 6;
  const Neighbours neighbours = [](const NeighbourVisitor& visit) {
    for (std::size_t i = 0; i < kSide * kSide; ++i) {
      if (i % kSide > 0) visit(i - 1, i);
      if (i >= kSide) visit(i - kSide, i);
    }
  };
  std::vector<double> radiance(kSide * kSide, 0.0);
  radiance[14] = 3.0;
  radiance[15] = 3.1;
  radiance[20] = 3.2;
  // Three regions that one ray sees each.
  EXPECT_EQ(regionRadiance(radiance, neighbours), radiance);
  radiance[21] = 3.3;
  std::vector<double> region = regionRadiance(radiance, neighbours);
  for (const std::size_t i : {14, 15, 20, 21}) EXPECT_DOUBLE_EQ(region[i], 3.15);
  EXPECT_EQ(region[13], 0.0);
  // A region one ray wide at a slant is no radiance that varies.
  std::vector<double> slanted(kSide * kSide, 0.0);
  for (std::size_t k = 0; k < kSide; ++k) slanted[k * kSide + k] = 2.0;
  EXPECT_EQ(regionRadiance(slanted, neighbours), slanted);
}

TEST(RadianceJump, NarrowsToTheSideOfLikeRadiance) {
  RadianceJump jump{{{1.0, 0.0, 0.0}, 0.0, 0.0}, {{0.0, 1.0, 0.0}, 1.0, 3.0}, 0.0, 3.0};
  jump.narrow({jump.middle(), 1.0, 2.9});
  EXPECT_EQ(jump.a.direction, Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(jump.b.radiance, 2.9);
  EXPECT_EQ(jump.jumpAcross({1.0, 0.0, 0.0}), -3.0);
  EXPECT_EQ(jump.jumpAcross({-1.0, 0.0, 0.0}), 3.0);
}

}  // namespace
}  // namespace irradiff
