#pragma once

#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/boundary/vector.h"
#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/sample_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

// The published sum over triangles as it stands, Eqs. (9) and (10) of [Schwarzhaupt et al. 2012]: one triangle after
// the other, side by side with arcs measured as angles. Slow, and at any scalar.

namespace irradiff {

struct RadiantTriangle {
  std::array<std::size_t, 3> corners;
  double radiance;
};

/// Inverse distance of the vertex on the horizon below a sample, from the sample's and the sine of its angle to the
/// normal.
using RimDepth = std::function<double(double inverse_distance, double sine)>;

inline double atInfinity(double /*inverse_distance*/, double /*sine*/) { return 0.0; }

enum class CornerRule { kFarthest, kNearest };

inline std::size_t sampleOf(const SampleMesh& mesh, std::size_t vertex) {
  return vertex < mesh.sampleCount() ? vertex : mesh.outermostSamples()[vertex - mesh.sampleCount()];
}

inline std::vector<RadiantTriangle> radiantTriangles(const SampleMesh& mesh, const HemisphereSamples& samples,
                                                     CornerRule rule = CornerRule::kFarthest) {
  std::vector<RadiantTriangle> triangles;
  for (const MeshTriangles& run : mesh.triangles()) {
    for (std::size_t k = 0; k < run.count; ++k) {
      RadiantTriangle triangle{{run.corners[0] + k, run.corners[1] + k, run.corners[2] + k}, 0.0};
      std::size_t chosen = sampleOf(mesh, triangle.corners[0]);
      for (const std::size_t corner : triangle.corners) {
        const std::size_t sample = sampleOf(mesh, corner);
        const double difference = samples.inverse_distance[sample] - samples.inverse_distance[chosen];
        if (rule == CornerRule::kFarthest ? difference < 0.0 : difference > 0.0) chosen = sample;
      }
      triangle.radiance = samples.radiance[chosen];
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

template <class Scalar>
struct MeshVertex {
  Vector3<Scalar> direction;
  Scalar inverse_distance;
};

/// The samples, their directions normalised once more, and the vertices on the horizon.
template <class Scalar>
std::vector<MeshVertex<Scalar>> meshVertices(const SampleMesh& mesh, const HemisphereSamples& samples,
                                             const RimDepth& rim_depth = atInfinity) {
  std::vector<MeshVertex<Scalar>> vertices;
  const auto add = [&vertices](const Eigen::Vector3d& w, double inverse_distance) {
    const Vector3<Scalar> direction(lift<Scalar>(w(0)), lift<Scalar>(w(1)), lift<Scalar>(w(2)));
    vertices.push_back(
        {scaled(direction, Scalar(lift<Scalar>(1.0) / norm(direction))), lift<Scalar>(inverse_distance)});
  };
  for (std::size_t i = 0; i < samples.shape.size(); ++i) add(samples.direction(i), samples.inverse_distance[i]);
  for (const std::size_t sample : mesh.outermostSamples()) {
    const Eigen::Vector3d w = samples.direction(sample);
    add({w(0), w(1), 0.0}, rim_depth(samples.inverse_distance[sample], std::hypot(w(0), w(1))));
  }
  return vertices;
}

template <class Scalar>
struct TriangleSum {
  Vector3<Scalar> gradient;
  Matrix3<Scalar> hessian;  ///< symmetric
};

template <class Scalar>
TriangleSum<Scalar> triangleSum(const std::vector<MeshVertex<Scalar>>& vertices,
                                const std::vector<RadiantTriangle>& triangles) {
  using std::atan2;
  const Scalar zero = lift<Scalar>(0.0);
  const Vector3<Scalar> nothing = Vector3<Scalar>::Constant(zero);
  const Vector3<Scalar> normal(zero, zero, lift<Scalar>(1.0));
  TriangleSum<Scalar> sum{nothing, Matrix3<Scalar>::Constant(zero)};
  for (const RadiantTriangle& triangle : triangles) {
    const Scalar radiance = lift<Scalar>(triangle.radiance);
    for (std::size_t i = 0; i < 3; ++i) {
      const MeshVertex<Scalar>& a = vertices[triangle.corners[i]];
      const MeshVertex<Scalar>& b = vertices[triangle.corners[(i + 1) % 3]];
      const Vector3<Scalar> moment = cross(a.direction, b.direction);
      const Scalar sine = norm(moment);
      const bool is_on_horizon = a.direction(2) == zero && b.direction(2) == zero;
      if (sine == zero || is_on_horizon) continue;
      BoundaryArc<Scalar> arc{};
      arc.plane_normal = scaled(moment, Scalar(lift<Scalar>(1.0) / sine));
      arc.turned_plane_normal = cross(normal, arc.plane_normal);
      arc.angle = atan2(sine, dot(a.direction, b.direction));
      // Only the antisymmetric part, which the sum over a triangle does not have, depends on these.
      arc.edge_direction = nothing;
      arc.angle_over_foot_distance = zero;
      arc.cancellation_distance = zero;
      arc.first = {a.direction, a.inverse_distance, a.direction(2)};
      arc.last = {b.direction, b.inverse_distance, b.direction(2)};
      const ArcTerms<Scalar> terms = arcTerms(arc, normal);
      const Scalar half = lift<Scalar>(0.5);
      for (int row = 0; row < 3; ++row) {
        sum.gradient(row) = sum.gradient(row) + radiance * terms.gradient(row);
        for (int column = 0; column < 3; ++column) {
          sum.hessian(row, column) =
              sum.hessian(row, column) + radiance * half * (terms.hessian(row, column) + terms.hessian(column, row));
        }
      }
    }
  }
  return sum;
}

template <class Scalar>
MeshDerivatives rounded(const TriangleSum<Scalar>& sum) {
  MeshDerivatives result;
  for (int i = 0; i < 3; ++i) {
    result.gradient(i) = static_cast<double>(sum.gradient(i));
    for (int j = 0; j < 3; ++j) result.hessian(i, j) = static_cast<double>(sum.hessian(i, j));
  }
  return result;
}

}  // namespace irradiff
