#pragma once

#include "derivatives/samples/strata.h"
#include "derivatives/samples/stratum_sides.h"

#include <Eigen/Core>

#include <numbers>
#include <vector>

namespace irradiff {

/// How a side of a stratum moves, from the motion of points alone: no formula of the estimators is in it.

/// Points of the side on the unit sphere, from corner to corner.
inline std::vector<Eigen::Vector3d> sidePoints(const Strata& strata, const StratumSide& side, std::size_t pieces) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(pieces);
    points.push_back(
        strata.direction({side.start.row, side.start.column, (1.0 - t) * side.start.along_row + t * side.end.along_row,
                          (1.0 - t) * side.start.along_column + t * side.end.along_column}));
  }
  return points;
}

/// A point in the unit direction `w` and at distance 1, seen from a receiver that has moved by `step`.
inline Eigen::Vector3d seenAfter(const Eigen::Vector3d& w, const Eigen::Vector3d& step) {
  return (w - step).normalized();
}

/// The derivative, for receivers moved along t and b, of the projected solid angle that the points of a side at
/// distance 1 sweep to the left of their path in the disk. By differences of second order in the step and the pieces.
inline Eigen::Vector2d sweptProjectedSolidAngle(const std::vector<Eigen::Vector3d>& points) {
  constexpr double kStep = 2e-5;
  Eigen::Vector2d rates = Eigen::Vector2d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    step(axis) = kStep;
    double area = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      // The quadrilateral between a piece seen from one step behind and from one step ahead.
      const Eigen::Vector3d behind_start = seenAfter(points[i], -step);
      const Eigen::Vector3d behind_end = seenAfter(points[i + 1], -step);
      const Eigen::Vector3d ahead_start = seenAfter(points[i], step);
      const Eigen::Vector3d ahead_end = seenAfter(points[i + 1], step);
      const Eigen::Vector3d one_diagonal = ahead_end - behind_start;
      const Eigen::Vector3d other_diagonal = ahead_start - behind_end;
      area += (one_diagonal.x() * other_diagonal.y() - one_diagonal.y() * other_diagonal.x()) / 2.0;
    }
    rates(axis) = area / (2.0 * kStep);
  }
  return rates;
}

}  // namespace irradiff
