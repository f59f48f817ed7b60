#include "experiments/ray_casting/ray_batch.h"

#include <algorithm>

// Compiled for several generations of processors, of which the program takes the best that it finds. All of them do the
// same operations, as none may fuse a product with a sum. The sanitizers do not go with the choice at start.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define IRRADIFF_FOR_EACH_PROCESSOR __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define IRRADIFF_FOR_EACH_PROCESSOR
#endif

namespace irradiff {

namespace {

/// What a block reads and writes stays in the fastest cache while the faces pass.
constexpr std::size_t kBlock = 512;

}  // namespace

IRRADIFF_FOR_EACH_PROCESSOR
void castRays(std::span<const ViewedFace> faces, const RayBatch& batch) {
  for (std::size_t begin = 0; begin < batch.count; begin += kBlock) {
    const std::size_t count = std::min(kBlock, batch.count - begin);
    const double* const t = batch.direction_t + begin;
    const double* const b = batch.direction_b + begin;
    const double* const n = batch.direction_n + begin;
    double* const nearest = batch.inverse_distance + begin;
    double* const radiance = batch.radiance + begin;
    std::fill_n(nearest, count, 0.0);
    std::fill_n(radiance, count, 0.0);
    for (const ViewedFace& face : faces) {
      const ViewedFace f = face;
#pragma omp simd
      for (std::size_t i = 0; i < count; ++i) {
        const double first = f.sides[0][0] * t[i] + f.sides[0][1] * b[i] + f.sides[0][2] * n[i];
        const double second = f.sides[1][0] * t[i] + f.sides[1][1] * b[i] + f.sides[1][2] * n[i];
        const double third = f.sides[2][0] * t[i] + f.sides[2][1] * b[i] + f.sides[2][2] * n[i];
        const double inverse =
            f.inverse_distance[0] * t[i] + f.inverse_distance[1] * b[i] + f.inverse_distance[2] * n[i];
        // Without short circuits: all four are known already, and a branch would be one for each ray.
        const bool is_seen =
            static_cast<bool>(static_cast<int>(first >= f.lowest[0]) & static_cast<int>(second >= f.lowest[1]) &
                              static_cast<int>(third >= f.lowest[2]) & static_cast<int>(inverse > nearest[i]));
        nearest[i] = is_seen ? inverse : nearest[i];
        radiance[i] = is_seen ? f.radiance : radiance[i];
      }
    }
  }
}

}  // namespace irradiff
