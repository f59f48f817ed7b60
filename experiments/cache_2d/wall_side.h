#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// One side of a segment, as a frame: the tangent is the normal turned clockwise, and who stands before the side sees
/// the coordinate along it grow counterclockwise.
struct WallSide {
  std::size_t segment = 0;
  Eigen::Vector2d origin, tangent, normal;
  double length = 0.0;

  Eigen::Vector2d local(const Eigen::Vector2d& point) const {
    return {(point - origin).dot(tangent), (point - origin).dot(normal)};
  }
  Eigen::Vector2d point(double along) const { return origin + along * tangent; }
};

/// Side `is_right` of a segment, whose tangent runs from its first vertex to the second or, on the right, back.
inline WallSide wallSide(const Segment& segment, std::size_t index, bool is_right) {
  const Eigen::Vector2d& a = segment.vertices[is_right ? 1 : 0];
  const Eigen::Vector2d& b = segment.vertices[is_right ? 0 : 1];
  const Eigen::Vector2d tangent = (b - a).normalized();
  return {index, a, tangent, {-tangent.y(), tangent.x()}, (b - a).norm()};
}

/// What a side cannot see: the segments on its own line, itself among them, to within the rounding of coordinates.
inline constexpr double kOwnLineTolerance = 1e-13;
std::vector<std::size_t> segmentsOffLine(std::span<const Segment> segments, const WallSide& side);

}  // namespace irradiff
