#include "experiments/figures/view_evaluation.h"

#include "derivatives/visibility/radiance_topology.h"

#include <gtest/gtest.h>

#include <vector>

namespace irradiff {
namespace {

/// A lamp that two black cards are below, both in front of it from the origin.
std::vector<Polygon> lampAndCards() {
  return {{"lamp", {{-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}}, 2.0},
          {"upper", {{-0.2, -0.3, 2}, {0.3, -0.2, 2}, {0.1, 0.4, 2}}, 0.0},
          {"lower", {{-0.1, -0.2, 1}, {0.25, 0.0, 1}, {0.0, 0.3, 1}}, 0.0}};
}

VisibleBoundary topologyAt(const std::vector<Polygon>& polygons, double x, double y) {
  return viewEvaluator(polygons)({{x, y, 0}, {0, 0, 1}}).topology;
}

TEST(RadianceTopology, ChangesWhereAnEdgePassesOverALampsCorner) {
  const std::vector<Polygon> polygons = lampAndCards();
  // From far to the right the cards are not before the lamp.
  EXPECT_TRUE(topologyAt(polygons, 9, 0) == topologyAt(polygons, 9.5, 0.25));
  EXPECT_FALSE(topologyAt(polygons, 9, 0) == topologyAt(polygons, 0.05, 0.05));
}

// With the lamp aside, the lower card moves past the upper one against the dark: no event of the radiance.
TEST(RadianceTopology, KnowsNothingOfBlackBeforeBlack) {
  std::vector<Polygon> cards = lampAndCards();
  for (Eigen::Vector3d& vertex : cards[0].vertices) {
    vertex += Eigen::Vector3d(5, 5, 0);
  }
  std::vector<Polygon> glowing = cards;
  glowing[1].radiance = 0.5;
  const auto changes = [](const std::vector<Polygon>& polygons) {
    std::size_t count = 0;
    const ViewEvaluator evaluate = viewEvaluator(polygons);
    VisibleBoundary last = evaluate({{-1.0, 0.013, 0}, {0, 0, 1}}).topology;
    for (int i = 1; i <= 60; ++i) {
      const VisibleBoundary next = evaluate({{-1.0 + 0.033 * i, 0.013, 0}, {0, 0, 1}}).topology;
      count += next == last ? 0 : 1;
      last = next;
    }
    return count;
  };
  const std::vector<Polygon> no_cards{cards[0]};
  EXPECT_EQ(changes(no_cards), 0U);
  EXPECT_EQ(changes(cards), 0U);
  EXPECT_GT(changes(glowing), 0U) << "the bad twin: where the upper card glows, the lower one shows before it";
}

TEST(RadianceTopology, TakesEqualRadiancesForOne) {
  const EdgePlace start{EdgePlace::Kind::kStart};
  const EdgePlace middle{EdgePlace::Kind::kEdge, 7};
  const EdgePlace end{EdgePlace::Kind::kEnd};
  // Polygons 0 and 3 glow alike, 1 and 2 are black.
  const std::vector<double> radiances{2, 0, 0, 2, 1};
  VisibleBoundary view;
  view.arcs = {{0, start, middle, {0, 1}}, {0, middle, end, {3, kNone}}, {1, start, end, {0, 3}},
               {2, start, end, {1, 2}},    {3, start, middle, {0, 4}},   {3, middle, end, {0, 1}}};
  view.apparent_vertices = {{0, 7, {0, 1}, {3, 2}}, {3, 7, {0, 4}, {0, 1}}, {2, 7, {1, 2}, {2, kNone}}};
  view.horizon = {{0, middle, 1, 2}, {3, middle, 4, 3}};
  view.is_seen = {true, true, true, true, true};
  VisibleBoundary expected;
  expected.arcs = {{0, start, end, {0, kNone}}, {3, start, middle, {0, 4}}, {3, middle, end, {0, kNone}}};
  expected.apparent_vertices = {{3, 7, {0, 4}, {0, kNone}}};
  expected.horizon = {{3, middle, 4, 0}};
  EXPECT_TRUE(radianceTopology(view, radiances) == expected);
  EXPECT_FALSE(radianceTopology(view, std::vector<double>{2, 0, 0, 3, 1}) == expected);
}

}  // namespace
}  // namespace irradiff
