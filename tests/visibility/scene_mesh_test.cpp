#include "derivatives/visibility/scene_mesh.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

Polygon polygon(std::vector<Vector3d> vertices) { return {"", std::move(vertices), 1.0}; }

/// In metres, rounded.
Vector3d positionOf(const SceneMesh& mesh, std::size_t point) {
  const MeshPoint& p = mesh.points()[point];
  const double start = p.start_weight.rounded();
  const double end = p.end_weight.rounded();
  return std::ldexp(1.0, mesh.exponent()) * (start * mesh.vertices()[p.start] + end * mesh.vertices()[p.end]) /
         (start + end);
}

/// The creases along the x axis, each as the x of its lower and upper end.
std::vector<std::pair<double, double>> creasesAlongX(const SceneMesh& mesh) {
  std::vector<std::pair<double, double>> creases;
  for (std::size_t e = mesh.firstCrease(); e < mesh.edges().size(); ++e) {
    creases.push_back(
        std::minmax({positionOf(mesh, mesh.edges()[e].start)(0), positionOf(mesh, mesh.edges()[e].end)(0)}));
  }
  std::ranges::sort(creases);
  return creases;
}

TEST(SceneMesh, PolygonsShareVerticesAndEdges) {
  const SceneMesh mesh(
      std::vector{polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), polygon({{1, 0, 0}, {1, 1, 0}, {2, 0, 1}})});
  EXPECT_EQ(mesh.vertices().size(), 5U);
  EXPECT_EQ(mesh.edges().size(), 6U);
  EXPECT_EQ(mesh.firstCrease(), 6U);
  ASSERT_EQ(mesh.faces().size(), 2U);
  std::vector<std::vector<std::size_t>> shared;
  for (const MeshEdge& edge : mesh.edges()) {
    if (edge.faces.size() > 1) shared.push_back(edge.faces);
  }
  EXPECT_THAT(shared, ElementsAre(ElementsAre(0U, 1U)));
  // Each face's edges run from its vertices to the next.
  for (const MeshFace& face : mesh.faces()) {
    for (std::size_t i = 0; i < face.vertices.size(); ++i) {
      const MeshEdge& edge = mesh.edges()[face.edges[i]];
      EXPECT_THAT((std::vector{edge.start, edge.end}),
                  UnorderedElementsAre(face.vertices[i], face.vertices[(i + 1) % face.vertices.size()]));
    }
  }
}

TEST(SceneMesh, ScalesTheLargestCoordinateBelowOne) {
  for (const double size : {0x1p-600, 0.75, 1.0, 12345.0, 0x1p600}) {
    const SceneMesh mesh(std::vector{polygon({{0, 0, 0}, {size, 0, 0}, {0, -0.5 * size, 0}})});
    double largest = 0.0;
    for (const Vector3d& v : mesh.vertices()) largest = std::max(largest, v.cwiseAbs().maxCoeff());
    EXPECT_GE(largest, 0.5);
    EXPECT_LT(largest, 1.0);
    EXPECT_EQ(std::ldexp(largest, mesh.exponent()), size);
  }
}

TEST(SceneMesh, APolygonThatLeavesItsPlaneIsTriangles) {
  const auto quad = [](double height) { return polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, height}, {0, 1, 0}}); };
  EXPECT_EQ(SceneMesh(std::vector{quad(0.0)}).faces().size(), 1U);
  const SceneMesh mesh(std::vector{quad(0x1p-60)});
  ASSERT_EQ(mesh.faces().size(), 2U);
  EXPECT_EQ(mesh.edges().size(), 5U);
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    EXPECT_EQ(mesh.faces()[f].polygon, 0U);
    for (const std::size_t v : mesh.faces()[f].vertices) EXPECT_EQ(mesh.planeOffset(f, v), 0);
  }
  // Its own triangles do not pass through each other, wherever the fold is.
  EXPECT_EQ(mesh.firstCrease(), mesh.edges().size());
}

TEST(SceneMesh, SidesOfPlanes) {
  const SceneMesh mesh(std::vector{polygon({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}),    // in z = 0
                                   polygon({{0, 0, 1}, {1, 0, 1}, {0, 1, 2}}),    // above
                                   polygon({{0, 0, -1}, {1, 0, -1}, {0, 1, 0}}),  // below, a vertex in it
                                   polygon({{0, 0, 1}, {1, 0, -1}, {0, 1, 1}}),   // through it
                                   polygon({{9, 9, 0}, {8, 9, 0}, {9, 8, 0}})});  // in it
  const int above = mesh.planeOffset(0, Vector3d(0.0, 0.0, 0.5));
  EXPECT_EQ(above, -mesh.planeOffset(0, Vector3d(0.0, 0.0, -0x1p-1000)));
  EXPECT_EQ(mesh.planeOffset(0, Vector3d(0.5, -3.0, 0.0)), 0);
  EXPECT_EQ(static_cast<int>(mesh.sideOfPlane(1, 0)), above);
  EXPECT_EQ(static_cast<int>(mesh.sideOfPlane(2, 0)), -above);
  EXPECT_EQ(mesh.sideOfPlane(3, 0), PlaneSide::kCrosses);
  EXPECT_EQ(mesh.sideOfPlane(4, 0), PlaneSide::kInPlane);
}

TEST(SceneMesh, ACreaseRunsFromWhereOneFaceIsEnteredToWhereOneIsLeft) {
  // An upright triangle over y = 0, of which z = 0 cuts out x in [0, 2]; the other covers x in [0.5, 3].
  const SceneMesh mesh(std::vector{polygon({{0, 0, -1}, {0, 0, 1}, {4, 0, -1}}),
                                   polygon({{0.5, -1, 0}, {3, -1, 0}, {3, 1, 0}, {0.5, 1, 0}})});
  EXPECT_THAT(creasesAlongX(mesh), ElementsAre(std::pair(0.5, 2.0)));
  const MeshEdge& crease = mesh.edges().back();
  EXPECT_TRUE(crease.is_crease);
  EXPECT_THAT(crease.faces, ElementsAre(0U, 1U));
  for (const std::size_t end : {crease.start, crease.end}) {
    EXPECT_EQ(mesh.planeOffset(0, end), 0);
    EXPECT_EQ(mesh.planeOffset(1, end), 0);
  }
}

TEST(SceneMesh, FacesThatTouchHaveNoCrease) {
  const Polygon ground = polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  const auto creases = [&](const Polygon& other) {
    const SceneMesh mesh(std::vector{ground, other});
    return mesh.edges().size() - mesh.firstCrease();
  };
  EXPECT_EQ(creases(polygon({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}})), 0U);          // stands on it
  EXPECT_EQ(creases(polygon({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}})), 0U);          // on a tip
  EXPECT_EQ(creases(polygon({{-2, -2, 0}, {2, -2, 0}, {0, -2, 1}})), 0U);      // shares an edge
  EXPECT_EQ(creases(polygon({{2, -1, -1}, {2, 1, -1}, {2, 0, 3}})), 0U);       // an edge of the ground in it
  EXPECT_EQ(creases(polygon({{2, 2, -1}, {3, 2, 1}, {3, 2, -1}})), 0U);        // beside it
  EXPECT_EQ(creases(polygon({{0, 0, -0x1p-900}, {1, 0, 1}, {0, 1, 1}})), 1U);  // a tip just through it
}

TEST(SceneMesh, AFaceThatIsNotConvexIsPiercedInSeveralPieces) {
  // A U with legs over x in [0, 1] and [2, 3], cut above its base; the gap's piece bounds nothing and does no harm.
  const Polygon u = polygon({{0, -1, 0}, {3, -1, 0}, {3, 2, 0}, {2, 2, 0}, {2, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}});
  const auto slab = [](double from, double to) {
    return polygon({{from, 1, -1}, {to, 1, -1}, {to, 1, 1}, {from, 1, 1}});
  };
  EXPECT_THAT(creasesAlongX(SceneMesh(std::vector{u, slab(0.5, 2.5)})),
              ElementsAre(std::pair(0.5, 1.0), std::pair(1.0, 2.0), std::pair(2.0, 2.5)));
  EXPECT_THAT(creasesAlongX(SceneMesh(std::vector{u, slab(-1.0, 0.75)})), ElementsAre(std::pair(0.0, 0.75)));
  EXPECT_THAT(creasesAlongX(SceneMesh(std::vector{u, slab(2.25, 2.75)})), ElementsAre(std::pair(2.25, 2.75)));
  EXPECT_TRUE(creasesAlongX(SceneMesh(std::vector{u, slab(3.25, 4.0)})).empty());
}

TEST(SceneMesh, CreasesOfNeighbouringTrianglesShareTheirEnd) {
  // A quadrilateral folded along a diagonal through z = 0, where the edge of its two triangles passes through the
  // other.
  const SceneMesh mesh(std::vector{polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}),
                                   polygon({{-1, 0, -1}, {1, 0, -1}, {1, 0x1p-40, 1}, {-1, 0, 1}})});
  ASSERT_EQ(mesh.faces().size(), 3U);
  ASSERT_EQ(mesh.edges().size() - mesh.firstCrease(), 2U);
  const MeshEdge& first = mesh.edges()[mesh.firstCrease()];
  const MeshEdge& second = mesh.edges()[mesh.firstCrease() + 1];
  std::vector<std::size_t> ends{first.start, first.end, second.start, second.end};
  std::ranges::sort(ends);
  const auto repeated = std::ranges::adjacent_find(ends);
  ASSERT_NE(repeated, ends.end());
  EXPECT_NEAR(positionOf(mesh, *repeated)(0), 0.0, 0x1p-50);
  // Nothing but the ends of creases is made.
  EXPECT_EQ(mesh.points().size(), mesh.vertices().size() + 3);
}

/// A point of the mesh in homogeneous coordinates, without error.
std::array<ExactNumber, 4> exactly(const SceneMesh& mesh, std::size_t point) {
  const MeshPoint& p = mesh.points()[point];
  if (p.face == kNone) {
    const Vector3d& v = mesh.vertices()[point];
    return {ExactNumber(v(0)), ExactNumber(v(1)), ExactNumber(v(2)), ExactNumber(1.0)};
  }
  std::array<ExactNumber, 4> sum;
  for (const auto& [vertex, weight] : {std::pair(p.start, p.start_weight), std::pair(p.end, p.end_weight)}) {
    for (int i = 0; i < 3; ++i) {
      sum[static_cast<std::size_t>(i)] =
          sum[static_cast<std::size_t>(i)] + weight * ExactNumber(mesh.vertices()[vertex](i));
    }
    sum[3] = sum[3] + weight;
  }
  return sum;
}

/// A minor of the matrix of these rows.
ExactNumber minor(const std::vector<std::array<ExactNumber, 4>>& rows, const std::vector<std::size_t>& columns) {
  if (rows.size() == 1) return rows[0][columns[0]];
  ExactNumber sum;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<std::size_t> others = columns;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(c));
    const ExactNumber term = rows[0][columns[c]] * minor({rows.begin() + 1, rows.end()}, others);
    sum = c % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

bool areCoplanar(const std::vector<std::array<ExactNumber, 4>>& points) {
  return minor(points, {0, 1, 2, 3}).sign() == 0;
}

bool areCollinear(const std::vector<std::array<ExactNumber, 4>>& points) {
  const std::vector<std::vector<std::size_t>> columns{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  return std::ranges::all_of(columns, [&](const auto& three) { return minor(points, three).sign() == 0; });
}

TEST(SceneMesh, WhatIsKnownAboutPointsIsTrue) {
  // A hexagon planar to the last bit, a folded quadrilateral through it, and a triangle through both and the fold.
  const SceneMesh mesh(
      std::vector{polygon({{-2, -1, 0}, {0, -2, 0}, {2, -1, 0}, {2, 1, 0}, {0, 2, 0}, {-2, 1, 0}}),
                  polygon({{-0.7, 0.1, -1}, {0.9, 0.3, -1.1}, {0.8, 0.25, 1}, {-0.6, 0.1, 0x1.0000000001p0}}),
                  polygon({{0.3, -1, -0.4}, {0.2, 1, 0.3}, {0.1, 0.9, 0.5}})});
  ASSERT_EQ(mesh.faces().size(), 4U);
  ASSERT_GT(mesh.edges().size(), mesh.firstCrease() + 2);
  std::size_t in_plane = 0;
  std::size_t outside = 0;
  for (std::size_t p = 0; p < mesh.points().size(); ++p) {
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
      const auto& [a, b, c] = mesh.faces()[f].plane;
      const bool is_in_plane = areCoplanar({exactly(mesh, p), exactly(mesh, a), exactly(mesh, b), exactly(mesh, c)});
      EXPECT_EQ(mesh.planeOffset(f, p) == 0, is_in_plane) << p << ' ' << f;
      EXPECT_EQ(mesh.isKnownInPlane(p, f), is_in_plane) << p << ' ' << f;  // nothing here lies in a plane by chance
      ++(is_in_plane ? in_plane : outside);
    }
    for (std::size_t e = 0; e < mesh.edges().size(); ++e) {
      const bool is_on_line =
          areCollinear({exactly(mesh, p), exactly(mesh, mesh.edges()[e].start), exactly(mesh, mesh.edges()[e].end)});
      EXPECT_EQ(mesh.isKnownOnLine(p, e), is_on_line) << p << ' ' << e;
    }
  }
  EXPECT_GT(in_plane, mesh.vertices().size());
  EXPECT_GT(outside, mesh.vertices().size());
}

using Triangle = std::array<Vector3d, 3>;

/// The part of a segment inside a triangle, both in one plane, by clipping at the planes through its sides.
std::optional<std::pair<Vector3d, Vector3d>> insideOf(const Triangle& triangle, Vector3d a, Vector3d b) {
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d inward = normal.cross(triangle[(i + 1) % 3] - triangle[i]);
    const double at_a = inward.dot(a - triangle[i]);
    const double at_b = inward.dot(b - triangle[i]);
    if (at_a <= 0.0 && at_b <= 0.0) return std::nullopt;
    if (at_a < 0.0) a += at_a / (at_a - at_b) * (b - a);
    if (at_b < 0.0) b += at_b / (at_b - at_a) * (a - b);
  }
  return std::pair(a, b);
}

/// The segment in which a triangle passes through another's plane; requires vertices on both sides.
std::pair<Vector3d, Vector3d> cutOf(const Triangle& triangle, const Triangle& other) {
  const Vector3d normal = (other[1] - other[0]).cross(other[2] - other[0]);
  std::vector<Vector3d> cuts;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& a = triangle[i];
    const Vector3d& b = triangle[(i + 1) % 3];
    const double at_a = normal.dot(a - other[0]);
    const double at_b = normal.dot(b - other[0]);
    if (at_a == 0.0) cuts.push_back(a);
    if (at_a * at_b < 0.0) cuts.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return {cuts.front(), cuts.back()};
}

TEST(SceneMesh, CreasesOfTrianglesAreTheirIntersections) {
  std::mt19937 random(20250601);
  const auto coordinate = [&] { return static_cast<double>(std::uniform_int_distribution(-4, 4)(random)); };
  std::size_t crossing = 0;
  std::size_t apart = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::array<Triangle, 2> triangles;
    bool is_flat = false;
    for (Triangle& triangle : triangles) {
      for (Vector3d& v : triangle) v = {coordinate(), coordinate(), coordinate()};
      is_flat = is_flat || (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm() == 0.0;
    }
    if (is_flat) continue;
    const SceneMesh mesh(std::vector{polygon({triangles[0].begin(), triangles[0].end()}),
                                     polygon({triangles[1].begin(), triangles[1].end()})});
    std::optional<std::pair<Vector3d, Vector3d>> expected;
    if (mesh.sideOfPlane(0, 1) == PlaneSide::kCrosses && mesh.sideOfPlane(1, 0) == PlaneSide::kCrosses) {
      const auto [from, to] = cutOf(triangles[0], triangles[1]);
      expected = insideOf(triangles[1], from, to);
      // Small integers: what is not nothing is longer than this.
      if (expected && (expected->second - expected->first).norm() < 1e-9) expected.reset();
    }
    ASSERT_EQ(mesh.edges().size() - mesh.firstCrease(), expected ? 1U : 0U) << trial;
    ++(expected ? crossing : apart);
    if (!expected) continue;
    const Vector3d start = positionOf(mesh, mesh.edges().back().start);
    const Vector3d end = positionOf(mesh, mesh.edges().back().end);
    const double straight = std::max((start - expected->first).norm(), (end - expected->second).norm());
    const double turned = std::max((start - expected->second).norm(), (end - expected->first).norm());
    EXPECT_LE(std::min(straight, turned), 1e-12) << trial;
  }
  EXPECT_GT(crossing, 300U);
  EXPECT_GT(apart, 300U);
}

}  // namespace
}  // namespace irradiff
