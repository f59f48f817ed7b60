#include "derivatives/estimators/radiance_jump.h"

#include <cmath>

namespace irradiff {

Eigen::Vector3d RadianceJump::middle() const { return (a.direction + b.direction).normalized(); }

double RadianceJump::halfWidth() const { return 0.5 * (a.direction - b.direction).norm(); }

const SeenPoint& RadianceJump::nearer() const {
  // Which of two equal distances is the smaller by rounding must not decide.
  constexpr double kRounding = 0x1p-30;
  return a.inverse_distance * (1.0 + kRounding) >= b.inverse_distance ? a : b;
}

double RadianceJump::jumpAcross(const Eigen::Vector3d& plane_normal) const {
  const double a_to_b = radiance_a - radiance_b;
  return plane_normal.dot(a.direction - b.direction) > 0.0 ? a_to_b : -a_to_b;
}

void RadianceJump::narrow(const SeenPoint& seen) {
  const bool is_like_a = std::abs(seen.radiance - a.radiance) <= std::abs(seen.radiance - b.radiance);
  (is_like_a ? a : b) = seen;
}

}  // namespace irradiff
