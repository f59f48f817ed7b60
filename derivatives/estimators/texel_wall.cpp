#include "derivatives/estimators/texel_wall.h"

#include <Eigen/Geometry>

#include <cmath>

namespace irradiff {

TexelWall texelWall(const Strata& strata, const StratumSide& side) {
  const Eigen::Vector3d start = strata.direction(side.start);
  const Eigen::Vector3d end = strata.direction(side.end);
  // The texel is on the left of the path, where start x end points.
  const Eigen::Vector3d across = start.cross(end);
  const double sine = across.norm();
  const double cosine = start.dot(end);
  // The integral of w along an arc of angle g from w0 to w1 is (w0 + w1) tan(g/2).
  return {-across / sine, std::atan2(sine, cosine), (start.z() + end.z()) * (sine / (1.0 + cosine))};
}

}  // namespace irradiff
