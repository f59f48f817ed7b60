#pragma once

#include "derivatives/estimators/radiance_jump.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>

namespace irradiff {

/// The line of a straight scene edge as the receiver sees it: its directions are a great circle, and along it the
/// inverse distance is linear in the direction.
struct SeenLine {
  Eigen::Vector3d plane_normal;  ///< unit normal of the plane through the receiver and the line
  Eigen::Vector3d depth;         ///< in that plane; the inverse distance in the unit direction w is depth.w; 1/m

  double inverseFootDistance() const;  ///< of the line's nearest point; 1/m
  /// 1/m; 0 in directions in which the line has gone to infinity.
  double inverseDistance(const Eigen::Vector3d& direction) const;
  /// Unit vector along the line, the way in which directions turn counterclockwise about plane_normal.
  Eigen::Vector3d edgeDirection() const;
};

/// The line through at least two of the jumps, numbered by `chosen` in their order along the boundary: least squares
/// with each jump's weight from its width across the line. No value if the first and the last jump are in one place.
std::optional<SeenLine> fitLine(std::span<const RadianceJump> jumps, std::span<const std::size_t> chosen);

/// Whether the line parts the two rays of each jump, and the nearer of them is at the line's distance, to within a
/// fraction of their separation.
bool partsJumps(const SeenLine& line, std::span<const RadianceJump> jumps, std::span<const std::size_t> chosen);

/// An end of what is known of a line: the last of its jumps, and how far the one before is from it, rad.
struct LineEnd {
  const SeenLine& line;
  const RadianceJump& jump;
  double spacing;
};

/// Where two lines cross in view, if that is in the gap between their ends, or nearer to it than the next jump would
/// be.
std::optional<Eigen::Vector3d> cornerBetween(const LineEnd& end, const LineEnd& start);

}  // namespace irradiff
