#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/cache_3d/room.h"
#include "experiments/cache_3d/surface_radiance.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// Nodes of the table along the longest extent of a room in one coordinate.
inline constexpr double kTableNodes = 100.0;

/// What the emitters of a room send to its surfaces, exactly, occlusion included.
class DirectLight {
 public:
  explicit DirectLight(const Room& room);

  /// Irradiance from the emitters. W/m^2. SceneEvaluator::evaluate, which is not asked where no emitter rises above the
  /// receiver's horizon. May be called from several threads at once. Throws InvalidScene as it does.
  double irradiance(const Receiver& receiver) const;

  /// reflectance/pi E: what a point of polygon `face` sends back of it, on the side that the receiver's normal points
  /// to. W/(m^2 sr).
  double radiance(std::size_t face, const Receiver& receiver) const;

  /// `radiance` as a table with nodes every 1/kTableNodes of the room's longest extent. How far it is from the analytic
  /// one is measured by direct_light_test.
  SurfaceRadiance tabulated(unsigned threads) const;

 private:
  SceneEvaluator scene_;
  std::vector<double> reflectances_;
  std::vector<Eigen::Vector3d> emitter_vertices_;
  double extent_ = 0.0;  ///< m
};

}  // namespace irradiff
