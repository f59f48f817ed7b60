#include "experiments/io/face_triangulation.h"

#include "derivatives/scene/orientation.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangle = std::array<std::size_t, 3>;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

std::vector<Vector3d> lifted(const std::vector<Vector2d>& plane, double height) {
  std::vector<Vector3d> vertices;
  vertices.reserve(plane.size());
  for (const Vector2d& p : plane)
    vertices.emplace_back(p.x(), p.y(), height * std::sin(7 * p.x()) * std::cos(5 * p.y()));
  return vertices;
}

/// Whether these are n - 2 triangles that turn like the face and whose edges are those of the face, once each, and
/// inner ones, once in each direction. Then their areas add up to the face, and none covers another or what is outside.
bool isTriangulation(const std::vector<Vector2d>& plane, const std::vector<Triangle>& triangles) {
  const std::size_t n = plane.size();
  double area = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d& next = plane[i + 1 == n ? 0 : i + 1];
    area += plane[i].x() * next.y() - plane[i].y() * next.x();
  }
  const int winding = area > 0 ? 1 : -1;
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const Triangle& t : triangles) {
    if (!(t[0] < t[1] && t[1] < t[2] && t[2] < n) || orientation(plane[t[0]], plane[t[1]], plane[t[2]]) != winding)
      return false;
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const bool is_outer = edge.second == (edge.first + 1 == n ? 0 : edge.first + 1);
    if (count != 1 || edges.contains({edge.second, edge.first}) == is_outer) return false;
  }
  return triangles.size() == n - 2;
}

void expectTriangulation(const std::vector<Vector2d>& plane, double height) {
  const auto triangles = triangulation(lifted(plane, height));
  ASSERT_TRUE(triangles.has_value());
  EXPECT_TRUE(isTriangulation(plane, *triangles));
}

TEST(Triangulation, SplitsAQuadrilateralAtItsShorterDiagonal) {
  EXPECT_THAT(*triangulation(std::vector<Vector3d>{{0, 0, 0}, {3, 1, 0}, {4, 4, 1}, {1, 3, 0}}),
              UnorderedElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
  EXPECT_THAT(*triangulation(std::vector<Vector3d>{{0, 2, 0}, {-3, 0, 0}, {0, -2, 1}, {3, 0, 0}}),
              UnorderedElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_THAT(*triangulation(std::vector<Vector3d>{{1, 2, 3}, {2, 3, 4}, {0, 0, 7}}), ElementsAre(Triangle{0, 1, 2}));
}

TEST(Triangulation, SplitsAConcaveQuadrilateralInsideAlongEachAxis) {
  // The only diagonal inside is the longer one, from the concave vertex 2.
  const std::vector<Vector2d> arrow{{0, 0}, {2, -0.5}, {1.9, 0}, {2, 0.5}};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vector3d> vertices;
    for (const Vector2d& p : arrow) {
      Vector3d vertex;
      vertex[axis] = 0.01 * p.x() * p.y() * p.y();
      vertex[(axis + 1) % 3] = p.x();
      vertex[(axis + 2) % 3] = p.y();
      vertices.push_back(vertex);
    }
    EXPECT_THAT(*triangulation(vertices), UnorderedElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3})) << axis;
  }
  // The test above can fail: the shorter diagonal is no triangulation.
  EXPECT_FALSE(isTriangulation(arrow, {{0, 1, 3}, {1, 2, 3}}));
  EXPECT_TRUE(isTriangulation(arrow, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_FALSE(isTriangulation(arrow, {{0, 1, 2}}));
}

TEST(Triangulation, IsRightForShapesOfEveryKind) {
  expectTriangulation({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}, 0.1);  // U
  expectTriangulation({{0, 4}, {1, 4}, {1, 1}, {3, 1}, {3, 4}, {4, 4}, {4, 0}, {0, 0}}, 0.1);  // the other way round
  expectTriangulation({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {0, 2}, {0, 1}}, 0.1);  // vertices on lines
  expectTriangulation({{0, 0}, {1, 0}, {2, 0}, {2, 2}}, 0.1);
  std::vector<Vector2d> spiral;
  spiral.reserve(200);
  for (int i = 0; i < 100; ++i)
    spiral.emplace_back((1 + 0.1 * i) * std::cos(0.2 * i), (1 + 0.1 * i) * std::sin(0.2 * i));
  for (int i = 99; i >= 0; --i)
    spiral.emplace_back((1.3 + 0.1 * i) * std::cos(0.2 * i), (1.3 + 0.1 * i) * std::sin(0.2 * i));
  expectTriangulation(spiral, 0.01);
}

TEST(Triangulation, IsRightForRandomStars) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (int repetition = 0; repetition < 300; ++repetition) {
    const int n = 4 + repetition % 40;
    std::vector<Vector2d> star;
    star.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      // Radii on a grid: collinear vertices and equal diagonals happen.
      const double r = repetition % 2 == 0 ? radius(random) : std::ceil(4 * radius(random)) / 4;
      const double angle = 2 * std::numbers::pi * i / n;
      star.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    if (repetition % 3 == 0) std::ranges::reverse(star);
    expectTriangulation(star, 0.001);
  }
}

TEST(Triangulation, TakesAnyAxisInWhichTheFaceIsSimple) {
  // Along z, the largest component of the area, it is a bow-tie of unequal wings.
  const std::vector<Vector3d> twisted{{0, 0, 0}, {3, 3, 0.2}, {3, 0, 0.4}, {0, 1, 0.6}};
  EXPECT_TRUE(triangulation(twisted).has_value());
}

TEST(Triangulation, GivesNothingForAFaceThatMeetsItselfOrHasTooManyVertices) {
  EXPECT_FALSE(triangulation(std::vector<Vector3d>{{0, 0, 0}, {1, 1, 1}, {1, 0, 0}, {0, 1, 0}}).has_value());
  std::vector<Vector3d> circle;
  for (std::size_t i = 0; i < kMaxSplitVertices; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kMaxSplitVertices);
    circle.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  EXPECT_EQ(triangulation(circle)->size(), kMaxSplitVertices - 2);
  circle.emplace_back(1, -1e-9, 0);
  EXPECT_FALSE(triangulation(circle).has_value());
}

TEST(Triangulation, DoesNotDependOnTheUnit) {
  const std::vector<Vector3d> face{{0, 0, 0}, {4, 0, 0.1}, {4, 4, 0}, {2, 1, 0.2}, {0, 4, 0}};
  const auto expected = triangulation(face);
  ASSERT_TRUE(expected.has_value());
  for (const double unit : {1e-300, 1e-150, 1e3, 1e150, 1e300}) {
    std::vector<Vector3d> scaled = face;
    for (Vector3d& vertex : scaled) vertex *= unit;
    EXPECT_EQ(triangulation(scaled), expected) << unit;
  }
}

}  // namespace
}  // namespace irradiff
