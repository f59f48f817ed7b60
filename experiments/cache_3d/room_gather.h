#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/scene/receiver.h"
#include "experiments/cache_3d/face_rays.h"
#include "experiments/cache_3d/surface_radiance.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace irradiff {

inline constexpr std::size_t kNoFace = static_cast<std::size_t>(-1);

/// What a gather has seen, and on which polygon: kNoFace for a ray that hit none.
struct RoomSamples {
  HemisphereSamples samples;
  std::vector<std::size_t> faces;
};

/// Final gathers in a room: one ray in each concentric stratum, jittered, in the frame of `tangentFrame(normal)`.
class RoomGather {
 public:
  /// Keeps a reference to the radiance, whose faces the polygons are. Throws std::invalid_argument as gatherShape().
  RoomGather(std::span<const Polygon> polygons, const SurfaceRadiance& radiance, GridShape shape, std::uint64_t seed);

  GridShape shape() const { return shape_; }

  /// What receiver number `point` gathers: a function of seed, point and receiver alone. May be called from several
  /// threads at once.
  RoomSamples gather(const Receiver& receiver, std::uint64_t point) const;

 private:
  FaceRays faces_;
  const SurfaceRadiance* radiance_;
  GridShape shape_;
  std::uint64_t seed_;
};

/// Concentric strata of `rays` rays. Throws std::invalid_argument naming the number unless it is the square of a number
/// that is at least 2.
GridShape gatherShape(std::size_t rays);

}  // namespace irradiff
