// Whatever meets an edge in view is among what the grid gives for it, and the number of its cells changes nothing.

#include "derivatives/visibility/view_grid.h"

#include "derivatives/visibility/scene_evaluation.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;

class RandomTriangles {
 public:
  explicit RandomTriangles(unsigned seed) : random_(seed) {}

  double number(double from, double to) { return std::uniform_real_distribution(from, to)(random_); }
  Vector3d inBox(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

  /// Most of them small, some as large as the scene.
  std::vector<Polygon> scene(std::size_t count) {
    std::vector<Polygon> polygons;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d center = inBox(1.0);
      const double size = std::exp(number(std::log(0.02), 0.0));
      polygons.push_back({"", {center + inBox(size), center + inBox(size), center + inBox(size)}, 1.0});
    }
    return polygons;
  }

 private:
  std::mt19937_64 random_;
};

/// Rounded, relative to the receiver.
Vector3d rayTo(const SceneMesh& mesh, std::size_t point, const Vector3d& position) {
  const MeshPoint& p = mesh.points()[point];
  const double start = p.start_weight.rounded();
  const double end = p.end_weight.rounded();
  return (start * mesh.vertices()[p.start] + end * mesh.vertices()[p.end]) / (start + end) - position;
}

/// Whether a ray from the receiver meets a triangle.
bool meets(const SceneMesh& mesh, const MeshFace& face, const Vector3d& position, const Vector3d& direction) {
  const Vector3d a = rayTo(mesh, face.vertices[0], position);
  const Vector3d b = rayTo(mesh, face.vertices[1], position);
  const Vector3d c = rayTo(mesh, face.vertices[2], position);
  const double whole = a.dot(b.cross(c));
  return direction.dot(b.cross(c)) * whole > 0.0 && a.dot(direction.cross(c)) * whole > 0.0 &&
         a.dot(b.cross(direction)) * whole > 0.0;
}

/// The direction in which two lines cross in view, or zero.
Vector3d crossing(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d direction = a.cross(b).cross(c.cross(d));
  for (const double sign : {1.0, -1.0}) {
    Vector3d w = sign * direction;
    const auto isBetween = [&](const Vector3d& from, const Vector3d& to) {
      const Vector3d plane = from.cross(to);
      return from.cross(w).dot(plane) > 0.0 && w.cross(to).dot(plane) > 0.0;
    };
    if (isBetween(a, b) && isBetween(c, d)) return w;
  }
  return Vector3d::Zero();
}

TEST(ViewGrid, LeavesOutNothingThatMeets) {
  std::size_t meetings_with_faces = 0;
  std::size_t meetings_with_creases = 0;
  std::size_t pairs = 0;
  std::size_t collected = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    RandomTriangles random(seed);
    const SceneMesh mesh(random.scene(seed % 3 == 0 ? 12 : 200));
    const Vector3d position = 0.25 * random.inBox(1.0);
    const Vector3d normal = seed % 2 == 0 ? Vector3d(0.0, 0.0, 1.0) : random.inBox(1.0).normalized();
    ViewGrid grid(mesh, position, normal, seed % 3 == 1 ? 1 : 9);
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) grid.insertFace(f);
    for (std::size_t c = mesh.firstCrease(); c < mesh.edges().size(); ++c) grid.insertCrease(c);
    for (std::size_t e = 0; e < mesh.edges().size(); ++e) {
      std::vector<std::size_t> faces;
      std::vector<std::size_t> creases;
      grid.collect(e, faces, creases);
      EXPECT_TRUE(std::ranges::is_sorted(faces) && std::ranges::adjacent_find(faces) == faces.end());
      pairs += mesh.faces().size();
      collected += faces.size();
      const Vector3d start = rayTo(mesh, mesh.edges()[e].start, position);
      const Vector3d end = rayTo(mesh, mesh.edges()[e].end, position);
      for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        bool is_met = false;
        constexpr int kSteps = 16;
        for (int i = 0; i <= kSteps && !is_met; ++i) {
          const Vector3d direction = start + i * (end - start) / kSteps;
          is_met = direction.dot(normal) > 0.0 && meets(mesh, mesh.faces()[f], position, direction);
        }
        if (!is_met) continue;
        ++meetings_with_faces;
        EXPECT_TRUE(std::ranges::binary_search(faces, f)) << "seed " << seed << " edge " << e << " face " << f;
      }
      for (std::size_t c = mesh.firstCrease(); c < mesh.edges().size(); ++c) {
        const Vector3d direction = crossing(start, end, rayTo(mesh, mesh.edges()[c].start, position),
                                            rayTo(mesh, mesh.edges()[c].end, position));
        if (!(direction.dot(normal) > 0.0)) continue;
        ++meetings_with_creases;
        EXPECT_TRUE(std::ranges::binary_search(creases, c)) << "seed " << seed << " edge " << e << " crease " << c;
      }
    }
  }
  EXPECT_GT(meetings_with_faces, 5000U);
  EXPECT_GT(meetings_with_creases, 300U);
  // And it does leave out.
  EXPECT_LT(collected, pairs / 2);
}

TEST(ViewGrid, KeepsWhatOnlyTouches) {
  // Edges that meet in a point of their outlines, on the horizon and on lines of the grid.
  const std::vector<Polygon> scene{{"", {{-1, -1, 1}, {0, -1, 1}, {0, 0, 1}, {-1, 0, 1}}, 1.0},
                                   {"", {{0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}, 1.0},
                                   {"", {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}}, 1.0}};
  const SceneMesh mesh(scene);
  ViewGrid grid(mesh, Vector3d::Zero(), Vector3d(0.0, 0.0, 1.0), 4);
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) grid.insertFace(f);
  const auto collects = [&](std::size_t edge, std::size_t face) {
    std::vector<std::size_t> faces;
    std::vector<std::size_t> creases;
    grid.collect(edge, faces, creases);
    return std::ranges::binary_search(faces, face);
  };
  for (const std::size_t edge : mesh.faces()[0].edges) {
    const MeshEdge& e = mesh.edges()[edge];
    const bool has_corner = e.start == mesh.faces()[0].vertices[2] || e.end == mesh.faces()[0].vertices[2];
    EXPECT_TRUE(!has_corner || collects(edge, 1)) << edge;
  }
  // (1, 0, 1) is seen on the edge from (0, 0, 2) to (2, 0, 2), the face's edge on the horizon on none.
  EXPECT_TRUE(collects(mesh.faces()[1].edges[0], 2));
  EXPECT_FALSE(collects(mesh.faces()[0].edges[0], 2));
}

TEST(ViewGrid, HasOneCellForFewFacesAndOneForEachOfMany) {
  EXPECT_EQ(viewGridResolution(1), 1);
  EXPECT_EQ(viewGridResolution(47), 1);
  EXPECT_EQ(viewGridResolution(48), 6);
  EXPECT_EQ(viewGridResolution(10000), 100);
}

// One cell compares every pair: it cannot leave out what the others do.
TEST(ViewGrid, CellsChangeNoBit) {
  std::size_t arcs = 0;
  std::size_t apparent_vertices = 0;
  std::size_t twins = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    RandomTriangles random(seed);
    std::vector<Polygon> scene = random.scene(seed % 2 == 0 ? 100 : 20);
    const Receiver receiver{0.25 * random.inBox(1.0), random.inBox(1.0).normalized()};
    const SceneEvaluator evaluator(scene);
    const VisibleBoundary view = evaluator.view(receiver, 1);
    const SceneEvaluation<3> sum = evaluator.evaluate(receiver, view, ApparentVertices::kMove);
    arcs += view.arcs.size();
    apparent_vertices += view.apparent_vertices.size();
    for (const int resolution : {2, 3, 7, 16, 61}) {
      const VisibleBoundary other_view = evaluator.view(receiver, resolution);
      EXPECT_TRUE(other_view == view) << "seed " << seed << ", " << resolution << " cells along a side";
      const SceneEvaluation<3> other = evaluator.evaluate(receiver, other_view, ApparentVertices::kMove);
      EXPECT_EQ(other.derivatives.irradiance.value, sum.derivatives.irradiance.value);
      EXPECT_EQ(other.derivatives.gradient.value, sum.derivatives.gradient.value);
      EXPECT_EQ(other.derivatives.hessian.value, sum.derivatives.hessian.value);
      EXPECT_EQ(other.bounds.hessian, sum.bounds.hessian);
    }
    EXPECT_TRUE(evaluator.view(receiver) == view);
    // The twin: a triangle that is seen gets lost, below the horizon.
    for (std::size_t i = 0; i < scene.size(); ++i) {
      if (!view.is_seen[i]) continue;
      const Vector3d below = receiver.position - 4.0 * receiver.normal;
      scene[i].vertices = {below + Vector3d::UnitX(), below + Vector3d::UnitY(), below + Vector3d::UnitZ()};
      EXPECT_FALSE(SceneEvaluator(scene).view(receiver, 16) == view) << "seed " << seed;
      ++twins;
      break;
    }
  }
  EXPECT_GT(arcs, 400U);
  EXPECT_GT(apparent_vertices, 100U);
  EXPECT_EQ(twins, 8U);
}

}  // namespace
}  // namespace irradiff
