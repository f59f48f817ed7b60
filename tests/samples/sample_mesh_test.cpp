// The mesh over hemisphere samples is a disk: each side of a triangle is an edge with that triangle beside it, the
// boundary is one closed line, the triangles face the receiver, and together they cover what they should.

#include "derivatives/samples/sample_mesh.h"

#include "derivatives/samples/sample_hemisphere.h"
#include "derivatives/samples/strata.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

struct Edge {
  std::size_t start, end, right, left;
};

/// A mesh written out, one entry for each triangle and edge.
struct PlainMesh {
  std::size_t outside;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<Edge> edges;
};

PlainMesh plainMesh(const SampleMesh& mesh) {
  PlainMesh plain{mesh.outside(), {}, {}};
  for (const MeshTriangles& run : mesh.triangles()) {
    EXPECT_EQ(run.first, plain.triangles.size());
    for (std::size_t k = 0; k < run.count; ++k) {
      plain.triangles.push_back({run.corners[0] + k, run.corners[1] + k, run.corners[2] + k});
    }
  }
  for (const auto* edges : {&mesh.edges(), &mesh.horizonEdges()}) {
    for (const MeshEdges& run : *edges) {
      for (std::size_t k = 0; k < run.count; ++k) {
        plain.edges.push_back({run.start + k, run.end + k, run.right + k, run.left + k});
      }
    }
  }
  return plain;
}

/// What is wrong with the edges; empty if nothing. `vertices` is their number.
std::string fault(const PlainMesh& mesh, std::size_t vertices) {
  std::ostringstream out;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> sides;
  std::set<std::size_t> used;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::pair side{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]};
      used.insert(side.first);
      if (!sides.emplace(side, t).second) out << "side " << side.first << " to " << side.second << " is there twice; ";
    }
  }
  const auto triangleBeside = [&](std::size_t start, std::size_t end) {
    const auto found = sides.find({start, end});
    return found == sides.end() ? mesh.outside : found->second;
  };
  std::set<std::pair<std::size_t, std::size_t>> listed;
  std::map<std::size_t, std::size_t> boundary;
  for (const Edge& edge : mesh.edges) {
    if (triangleBeside(edge.start, edge.end) != edge.right || triangleBeside(edge.end, edge.start) != edge.left) {
      out << "edge " << edge.start << " to " << edge.end << " has the wrong triangles; ";
    }
    listed.insert({edge.start, edge.end});
    listed.insert({edge.end, edge.start});
    if (edge.left == mesh.outside) boundary[edge.start] = edge.end;
    if (edge.right == mesh.outside) out << "edge " << edge.start << " to " << edge.end << " has nothing on its right; ";
  }
  if (listed.size() != 2 * mesh.edges.size()) out << "an edge is listed twice; ";
  for (const auto& [side, triangle] : sides) {
    if (!listed.contains(side)) out << "side " << side.first << " to " << side.second << " is no edge; ";
  }
  if (used.size() != vertices) out << used.size() << " of " << vertices << " vertices used; ";
  const auto euler =
      static_cast<std::ptrdiff_t>(vertices + mesh.triangles.size()) - static_cast<std::ptrdiff_t>(mesh.edges.size());
  if (euler != 1) out << "Euler characteristic " << euler << "; ";
  std::size_t length = 0;
  if (!boundary.empty()) {
    std::size_t at = boundary.begin()->first;
    do {
      at = boundary.contains(at) ? boundary[at] : boundary.begin()->first;
      ++length;
    } while (at != boundary.begin()->first);
  }
  if (length == 0 || length != boundary.size()) out << "the boundary is not one line; ";
  return out.str();
}

struct MeshCase {
  Stratification stratification;
  GridShape shape;
};

std::vector<MeshCase> meshCases() {
  std::vector<MeshCase> cases;
  for (const GridShape shape : {GridShape{2, 2}, {2, 5}, {3, 3}, {5, 2}, {8, 8}, {5, 7}, {16, 16}}) {
    cases.push_back({Stratification::kConcentric, shape});
  }
  for (const GridShape shape : {GridShape{1, 4}, {1, 9}, {5, 4}, {2, 5}, {3, 7}, {8, 24}}) {
    cases.push_back({Stratification::kPolar, shape});
  }
  for (const std::size_t n : {2U, 4U, 6U, 16U}) cases.push_back({Stratification::kHemicube, {3 * n, n}});
  return cases;
}

std::string describe(const MeshCase& mesh_case, MeshRim rim) {
  std::ostringstream out;
  out << (rim == MeshRim::kOpen ? "open" : "closed") << ", stratification "
      << static_cast<int>(mesh_case.stratification) << ", " << mesh_case.shape.rows << " x " << mesh_case.shape.columns;
  return out.str();
}

std::size_t vertexCount(const SampleMesh& mesh) {
  return mesh.sampleCount() + (mesh.horizonEdges().empty() ? 0 : mesh.outermostSamples().size());
}

/// Of all vertices.
std::vector<Eigen::Vector3d> directions(const SampleMesh& mesh, const MeshCase& mesh_case, SamplePattern pattern) {
  const SampleFrame frame{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                          Eigen::Vector3d::UnitZ()};
  const HemisphereSamples samples = sampleHemisphere(Strata(mesh_case.stratification, mesh_case.shape), pattern, 2012,
                                                     0, frame, [](const Eigen::Vector3d&) { return RayHit{}; });
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < mesh.sampleCount(); ++i) result.push_back(samples.direction(i));
  for (const std::size_t sample : mesh.outermostSamples()) {
    const Eigen::Vector3d w = samples.direction(sample);
    result.push_back(Eigen::Vector3d(w.x(), w.y(), 0.0).normalized());
  }
  return result;
}

/// Projected solid angle of a spherical triangle, negative if it is turned over, and the sum of what it was added up
/// from (Lambert's formula).
std::pair<double, double> projectedSolidAngle(const std::array<Eigen::Vector3d, 3>& corners) {
  double sum = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d normal = corners[i].cross(corners[(i + 1) % 3]);
    const double sine = normal.norm();
    if (sine == 0.0) continue;
    const double angle = std::atan2(sine, corners[i].dot(corners[(i + 1) % 3]));
    sum += 0.5 * angle * normal.z() / sine;
    size += 0.5 * angle;
  }
  return {sum, size};
}

TEST(SampleMesh, IsADiskWithEachEdgeListedOnce) {
  for (const MeshCase& mesh_case : meshCases()) {
    for (const MeshRim rim : {MeshRim::kOpen, MeshRim::kDownToHorizon}) {
      const SampleMesh mesh(mesh_case.stratification, mesh_case.shape, rim);
      EXPECT_EQ(fault(plainMesh(mesh), vertexCount(mesh)), "") << describe(mesh_case, rim);
      EXPECT_EQ(plainMesh(mesh).triangles.size(), mesh.triangleCount()) << describe(mesh_case, rim);
    }
  }
}

TEST(SampleMesh, WithAFaultIsFoundOut) {
  const SampleMesh mesh(Stratification::kHemicube, {12, 4}, MeshRim::kDownToHorizon);
  const PlainMesh good = plainMesh(mesh);
  const auto faultAfter = [&](const auto& change) {
    PlainMesh bad = good;
    change(bad);
    return fault(bad, vertexCount(mesh));
  };
  EXPECT_NE(faultAfter([](PlainMesh& m) { m.edges.erase(m.edges.begin() + 7); }), "") << "an edge missing";
  EXPECT_NE(faultAfter([](PlainMesh& m) { m.edges.push_back(m.edges[3]); }), "") << "an edge twice";
  EXPECT_NE(faultAfter([](PlainMesh& m) { std::swap(m.edges[9].left, m.edges[9].right); }), "") << "sides swapped";
  EXPECT_NE(faultAfter([](PlainMesh& m) { std::swap(m.triangles[5][0], m.triangles[5][1]); }), "") << "turned over";
  EXPECT_NE(faultAfter([](PlainMesh& m) { m.triangles.pop_back(); }), "") << "a triangle missing";
}

TEST(SampleMesh, BoundaryFollowsTheOutermostSamples) {
  for (const MeshCase& mesh_case : meshCases()) {
    for (const MeshRim rim : {MeshRim::kOpen, MeshRim::kDownToHorizon}) {
      const SampleMesh mesh(mesh_case.stratification, mesh_case.shape, rim);
      const std::vector<std::size_t>& outermost = mesh.outermostSamples();
      std::map<std::size_t, std::size_t> boundary;
      for (const Edge& edge : plainMesh(mesh).edges) {
        if (edge.left == mesh.outside()) boundary[edge.start] = edge.end;
      }
      ASSERT_EQ(boundary.size(), outermost.size()) << describe(mesh_case, rim);
      for (std::size_t k = 0; k < outermost.size(); ++k) {
        const std::size_t next = (k + 1) % outermost.size();
        const bool is_open = rim == MeshRim::kOpen;
        EXPECT_EQ(boundary[is_open ? outermost[k] : mesh.sampleCount() + k],
                  is_open ? outermost[next] : mesh.sampleCount() + next)
            << describe(mesh_case, rim);
      }
    }
  }
}

TEST(SampleMesh, FacesTheReceiverAtTheCentresOfStrata) {
  for (const MeshCase& mesh_case : meshCases()) {
    const SampleMesh mesh(mesh_case.stratification, mesh_case.shape, MeshRim::kDownToHorizon);
    const std::vector<Eigen::Vector3d> w = directions(mesh, mesh_case, SamplePattern::kCentred);
    for (const auto& [a, b, c] : plainMesh(mesh).triangles) {
      EXPECT_GT(w[a].dot(w[b].cross(w[c])), 0.0)
          << describe(mesh_case, MeshRim::kDownToHorizon) << ", triangle " << a << ' ' << b << ' ' << c;
    }
  }
}

TEST(SampleMesh, ClosedCoversTheHemisphereOnceWhereverTheSamplesAre) {
  for (const MeshCase& mesh_case : meshCases()) {
    const SampleMesh mesh(mesh_case.stratification, mesh_case.shape, MeshRim::kDownToHorizon);
    const std::vector<Eigen::Vector3d> w = directions(mesh, mesh_case, SamplePattern::kJittered);
    double covered = 0.0;
    double covered_by_samples = 0.0;
    double size = 0.0;
    for (const auto& [a, b, c] : plainMesh(mesh).triangles) {
      const auto [angle, angle_size] = projectedSolidAngle({w[a], w[b], w[c]});
      covered += angle;
      size += angle_size;
      if (std::max({a, b, c}) < mesh.sampleCount()) covered_by_samples += angle;
    }
    // Product 2, its norm 3, quotient 1, atan2 of that and of a product of 3 with 4: 16 and the sum's own roundings.
    const double bound = (16.0 + static_cast<double>(mesh.triangleCount())) * kUnitRoundoff * size;
    EXPECT_NEAR(covered, std::numbers::pi, bound) << describe(mesh_case, MeshRim::kDownToHorizon);
    EXPECT_LT(covered_by_samples, std::numbers::pi - bound) << describe(mesh_case, MeshRim::kDownToHorizon);
  }
}

TEST(SampleMesh, IsEmptyWhereNeighboursSpanNoTriangle) {
  for (const MeshCase& mesh_case : {MeshCase{Stratification::kConcentric, {1, 1}},
                                    {Stratification::kConcentric, {1, 9}},
                                    {Stratification::kConcentric, {9, 1}},
                                    {Stratification::kPolar, {5, 1}},
                                    {Stratification::kPolar, {5, 3}}}) {
    for (const MeshRim rim : {MeshRim::kOpen, MeshRim::kDownToHorizon}) {
      const SampleMesh mesh(mesh_case.stratification, mesh_case.shape, rim);
      EXPECT_TRUE(mesh.isEmpty() && mesh.edges().empty()) << describe(mesh_case, rim);
    }
  }
}

TEST(SampleMesh, IsListedInRowsNotOneByOne) {
  for (const MeshCase& mesh_case : {MeshCase{Stratification::kConcentric, {64, 64}},
                                    {Stratification::kPolar, {32, 128}},
                                    {Stratification::kHemicube, {96, 32}}}) {
    const SampleMesh mesh(mesh_case.stratification, mesh_case.shape, MeshRim::kDownToHorizon);
    const std::size_t border = mesh_case.shape.rows + mesh_case.shape.columns;
    EXPECT_LT(mesh.edges().size(), 10 * border) << describe(mesh_case, MeshRim::kDownToHorizon);
    EXPECT_LT(mesh.triangles().size(), 10 * border) << describe(mesh_case, MeshRim::kDownToHorizon);
  }
}

}  // namespace
}  // namespace irradiff
