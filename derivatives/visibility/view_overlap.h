#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace irradiff {

/// The part of a polygon above the horizon, as seen from the receiver: convex pieces, each a cyclic list of unit
/// directions.
struct PolygonView {
  struct Direction {
    Eigen::Vector3d unit;
    double uncertainty;  ///< sine of the angle by which rounding of coordinates may have moved it
  };
  std::vector<std::vector<Direction>> pieces;
};

/// Of a polygon by its triangles, as vertex indices.
PolygonView viewOf(const Polygon& polygon, std::span<const std::array<std::size_t, 3>> triangles,
                   const Receiver& receiver);

/// Whether the interiors of two views overlap by more than the uncertainty of their directions: no plane through the
/// receiver and an edge of a pair of pieces separates them.
bool overlap(const PolygonView& a, const PolygonView& b);

/// The angle that a segment subtends above the horizon, from `first` counterclockwise to `last`; nothing if it does not
/// rise above it or is seen end-on.
struct SegmentView {
  Eigen::Vector2d first, last;  ///< unit
  double uncertainty;
};

std::optional<SegmentView> viewOf(const Segment& segment, const FlatlandReceiver& receiver);

bool overlap(const SegmentView& a, const SegmentView& b);

}  // namespace irradiff
