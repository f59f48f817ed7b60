#pragma once

#include "derivatives/samples/ray_query.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace irradiff {

/// A ray from the receiver with what it sees.
struct SeenPoint {
  Eigen::Vector3d direction;      ///< unit, in the sample frame (t, b, n)
  double inverse_distance = 0.0;  ///< 1/m; 0 if the ray hits nothing
  double radiance = 0.0;          ///< W/(m^2 sr)
};

/// Two rays between which the radiance boundary passes: one in each of two neighbouring regions. More rays between them
/// bring them nearer to each other.
struct RadianceJump {
  SeenPoint a, b;
  double radiance_a = 0.0, radiance_b = 0.0;  ///< of the regions; W/(m^2 sr)

  Eigen::Vector3d middle() const;  ///< unit direction: where the boundary is, to within halfWidth()
  double halfWidth() const;        ///< rad
  /// The ray that hits the surface whose edge it is that bounds: the occluding one. At equal distance, to rounding, a.
  const SeenPoint& nearer() const;
  /// Radiance on the side of the plane through the receiver to which `plane_normal` points, minus that on the other.
  double jumpAcross(const Eigen::Vector3d& plane_normal) const;
  /// Puts `seen`, a ray between a and b, in the place of the one whose region it is in: the one of like radiance.
  void narrow(const SeenPoint& seen);
};

/// Where radiance jumps, and which jumps are on the same boundary. Jumps are numbered as in `jumps`.
struct JumpGraph {
  std::vector<RadianceJump> jumps;
  std::vector<std::array<std::size_t, 2>> links;    ///< the boundary goes from one to the other
  std::vector<std::vector<std::size_t>> junctions;  ///< boundaries of more than two regions meet between these
  std::vector<std::size_t> rim;                     ///< the boundary goes on to the horizon
  double horizon_radiance = 0.0;                    ///< along the horizon, where no boundary reaches it
};

}  // namespace irradiff
