#pragma once

#include "experiments/ray_casting/viewed_face.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace irradiff {

/// Rays from one receiver: where their directions are, in the frame (t, b, n), and where what they see goes. `count` of
/// each; nothing overlaps.
struct RayBatch {
  const double* direction_t;
  const double* direction_b;
  const double* direction_n;
  double* inverse_distance;  ///< in the unit of the faces
  double* radiance;
  std::size_t count;
};

/// The inverse distance at which a ray in direction w hits the face, 0 or less if it does not.
inline double inverseDistance(const ViewedFace& face, const Eigen::Vector3d& w) {
  const auto product = [&w](const Eigen::Vector3d& v) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; };
  const bool is_in_image = product(face.sides[0]) >= face.lowest[0] && product(face.sides[1]) >= face.lowest[1] &&
                           product(face.sides[2]) >= face.lowest[2];
  return is_in_image ? product(face.inverse_distance) : 0.0;
}

/// Casts every ray at every face. The nearest face counts, the first of those that are at one distance; a ray that hits
/// none sees inverse distance 0 and radiance 0. A ray's result has the same bits in any batch and on any machine, those
/// of inverseDistance().
void castRays(std::span<const ViewedFace> faces, const RayBatch& batch);

}  // namespace irradiff
