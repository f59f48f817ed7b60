#include "experiments/ray_casting/viewed_face.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace irradiff {

namespace {

constexpr double kUnderflow = std::numeric_limits<double>::min();

double sumOfMagnitudes(const Eigen::Vector3d& v) { return v.lpNorm<1>(); }

}  // namespace

std::optional<ViewedFace> viewedFace(const SceneFace& face, const SampleFrame& frame) {
  const Eigen::Matrix3d to_frame = frame.axes().transpose();
  std::array<Eigen::Vector3d, 3> offsets;
  std::array<Eigen::Vector3d, 3> seen;
  for (std::size_t i = 0; i < 3; ++i) {
    offsets[i] = face.vertices[i] - frame.position;
    seen[i] = to_frame * offsets[i];
  }
  if (std::ranges::all_of(seen, [](const Eigen::Vector3d& v) { return v.z() <= 0.0; })) return std::nullopt;

  const Eigen::Vector3d along = face.vertices[1] - face.vertices[0];
  const Eigen::Vector3d across = face.vertices[2] - face.vertices[0];
  const Eigen::Vector3d normal = along.cross(across);
  const double distance = normal.dot(offsets[0]);
  double largest_coordinate = frame.position.lpNorm<Eigen::Infinity>();
  for (const Eigen::Vector3d& vertex : face.vertices) {
    largest_coordinate = std::max(largest_coordinate, vertex.lpNorm<Eigen::Infinity>());
  }
  // What moving each coordinate by a share of the largest does to the product, in the first order.
  const double sensitivity = sumOfMagnitudes(normal) +
                             (sumOfMagnitudes(along) + sumOfMagnitudes(across)) * offsets[0].lpNorm<Eigen::Infinity>();
  if (std::abs(distance) <= kPlaneRounding * sensitivity * largest_coordinate + kUnderflow) return std::nullopt;

  ViewedFace viewed;
  viewed.radiance = face.radiance;
  viewed.inverse_distance = to_frame * normal / distance;
  // Vertices in the order in which the determinant of their positions is positive.
  const double turn = distance > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const Eigen::Vector3d edge = face.vertices[next] - face.vertices[i];
    viewed.sides[i] = turn * seen[i].cross(to_frame * edge);
    viewed.lowest[i] = -(kSideRounding * sumOfMagnitudes(offsets[i]) * sumOfMagnitudes(edge) + kUnderflow);
  }
  return viewed;
}

}  // namespace irradiff
