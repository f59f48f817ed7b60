#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace irradiff {

/// The end of a segment: u, and how it responds where the receiver moves in its tangent plane.
struct SliceEnd {
  double u = 0.0;
  Eigen::Vector2d motion = Eigen::Vector2d::Zero();  ///< du/dx along t and b; 1/m
};

/// A face as it appears in one half-plane through the receiver's normal: a segment in the quarter plane (s, h), s along
/// the half-plane's azimuth, h along the normal. A direction is told by u = sin^2 of its angle to the normal.
struct SliceSegment {
  std::size_t face = 0;
  Eigen::Vector2d inverse;  ///< 1/r of its line in direction w = (sin, cos) is inverse.w; 1/m
  /// The same line's motion: where the receiver moves by dx, `inverse` changes by inverse * (plane.dx), plane being the
  /// tangential part of q, q.p = 1 on the face's plane. 1/m
  Eigen::Vector2d plane;
  SliceEnd begin;  ///< its end nearer the normal
  SliceEnd end;    ///< the other, of greater u
};

/// A stretch in which one segment is nearer than all others.
struct VisiblePart {
  std::size_t segment = 0;
  SliceEnd begin;
  SliceEnd end;
};

/// (sin, cos) of a direction.
inline Eigen::Vector2d sliceDirection(double u) { return {std::sqrt(u), std::sqrt(1.0 - u)}; }

/// The nearest segments over the whole quarter, in order; where there is none there is no part. Segments may cross.
/// Stretches in u below kShortestPart are left out. O(n^2) in their number.
void findVisibleParts(const std::vector<SliceSegment>& segments, std::vector<VisiblePart>& parts);

inline constexpr double kShortestPart = 1e-14;

}  // namespace irradiff
