#pragma once

#include "derivatives/flatland/segment_form.h"

#include <Eigen/Core>

namespace irradiff {

/// A hit as seen from the receiver.
struct SeenHit {
  Eigen::Vector2d direction;  ///< unit
  double inverse_distance = 0.0;
};

// How steep the line through two hits is at the first: the vector q with q.p = 1 on the line, p from the receiver, is
// u w + slope J w. Along a line 1/r = q.w is linear in the direction:
//   q.w' = u':   slope = (u' - u w.w')/(w x w'),   1 - w.w' = |w' - w|^2/2
// 1/m. Not finite if the two directions are the same.
inline double slopeAtFirst(const SeenHit& first, const SeenHit& second) {
  const Eigen::Vector2d step = second.direction - first.direction;
  const double rise = second.inverse_distance - first.inverse_distance;
  return (rise + 0.5 * first.inverse_distance * step.squaredNorm()) / cross<double>(first.direction, step);
}

/// The vector q of the line through `hit` with this slope.
inline Eigen::Vector2d lineWithSlope(const SeenHit& hit, double slope) {
  return hit.inverse_distance * hit.direction + slope * quarterTurn(hit.direction);
}

}  // namespace irradiff
