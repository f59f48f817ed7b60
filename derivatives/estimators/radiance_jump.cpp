#include "derivatives/estimators/radiance_jump.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

Eigen::Vector3d RadianceJump::middle() const { return (a.direction + b.direction).normalized(); }

double RadianceJump::halfWidth() const { return 0.5 * (a.direction - b.direction).norm(); }

double RadianceJump::jumpAcross(const Eigen::Vector3d& plane_normal) const {
  const double a_to_b = radiance_a - radiance_b;
  return plane_normal.dot(a.direction - b.direction) > 0.0 ? a_to_b : -a_to_b;
}

void RadianceJump::narrow(const SeenPoint& seen) {
  const bool is_like_a = std::abs(seen.radiance - a.radiance) <= std::abs(seen.radiance - b.radiance);
  (is_like_a ? a : b) = seen;
}

double jumpThreshold(std::vector<double> differences) {
  constexpr double kStandsOut = 8.0;
  if (differences.empty()) return 0.0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return kStandsOut * *middle;
}

}  // namespace irradiff
