#pragma once

#include <Eigen/Core>

namespace irradiff {

/// Order in which a plane sweep meets points: by x, then by y. Equivalent to shearing the plane by an infinitesimal
/// angle, so that no edge is vertical.
inline bool sweptBefore(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
}

}  // namespace irradiff
