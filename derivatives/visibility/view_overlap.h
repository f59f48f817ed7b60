#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <Eigen/Core>

#include <array>
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

/// Triangles (vertex indices) that cover a simple planar polygon, by ear clipping; a fan where the polygon is convex.
/// Requires a validated polygon.
std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon);

PolygonView viewOf(const Polygon& polygon, std::span<const std::array<std::size_t, 3>> triangles,
                   const Receiver& receiver);

/// Whether the interiors of two views overlap by more than the uncertainty of their directions: no plane through the
/// receiver and an edge of a pair of pieces separates them.
bool overlap(const PolygonView& a, const PolygonView& b);

}  // namespace irradiff
