#include "experiments/cache_3d/direct_light.h"

#include <algorithm>
#include <numbers>

namespace irradiff {

DirectLight::DirectLight(const Room& room) : scene_(room.polygons), reflectances_(room.reflectances) {
  for (const Polygon& polygon : room.polygons) {
    if (polygon.radiance > 0.0) {
      emitter_vertices_.insert(emitter_vertices_.end(), polygon.vertices.begin(), polygon.vertices.end());
    }
  }
  extent_ = extentOf(room);
}

double DirectLight::irradiance(const Receiver& receiver) const {
  const bool is_lit = std::ranges::any_of(emitter_vertices_, [&receiver](const Eigen::Vector3d& vertex) {
    return receiver.normal.dot(vertex - receiver.position) > 0.0;
  });
  return is_lit ? scene_.evaluate(receiver).derivatives.irradiance.value : 0.0;
}

double DirectLight::radiance(std::size_t face, const Receiver& receiver) const {
  if (reflectances_[face] == 0.0) return 0.0;
  return reflectances_[face] * std::numbers::inv_pi * irradiance(receiver);
}

SurfaceRadiance DirectLight::tabulated(unsigned threads) const {
  return {scene_.polygons(), extent_ / kTableNodes,
          [this](std::size_t face, const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
            return radiance(face, {position, normal});
          },
          threads};
}

}  // namespace irradiff
