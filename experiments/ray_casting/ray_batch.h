#pragma once

#include "experiments/ray_casting/viewed_face.h"

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

/// Casts every ray at every face. The nearest face counts, the first of those that are at one distance; a ray that hits
/// none sees inverse distance 0 and radiance 0. A ray's result has the same bits in any batch and on any machine.
void castRays(std::span<const ViewedFace> faces, const RayBatch& batch);

}  // namespace irradiff
