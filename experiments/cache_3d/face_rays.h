#pragma once

#include "derivatives/scene/polygon.h"
#include "experiments/ray_casting/ray_caster.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace irradiff {

/// Rays that tell which polygon they hit: for the caster each polygon radiates its own number plus 1, so that the
/// radiance that a ray brings back names it, exactly up to 2^53 polygons.
class FaceRays {
 public:
  explicit FaceRays(std::span<const Polygon> polygons) : caster_(numbered(polygons)) {}

  /// As RayCaster::from; this must outlive the result.
  ReceiverRays from(const SampleFrame& frame) const { return caster_.from(frame); }

  /// Number of the polygon behind a ray's radiance; nothing if the ray hit none.
  static std::optional<std::size_t> faceOf(double radiance) {
    if (radiance == 0.0) return std::nullopt;
    return static_cast<std::size_t>(radiance) - 1;
  }

 private:
  static std::vector<Polygon> numbered(std::span<const Polygon> polygons) {
    std::vector<Polygon> result(polygons.begin(), polygons.end());
    for (std::size_t i = 0; i < result.size(); ++i) result[i].radiance = static_cast<double>(i + 1);
    return result;
  }

  RayCaster caster_;
};

}  // namespace irradiff
