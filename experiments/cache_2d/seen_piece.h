#pragma once

#include "derivatives/flatland/segment_visibility.h"
#include "experiments/cache_2d/sight_terms.h"
#include "experiments/cache_2d/wall_side.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// A receiver with its frame: the tangent is the normal turned clockwise.
struct FlatlandFrame {
  Eigen::Vector2d position, tangent, normal;

  Eigen::Vector2d local(const Eigen::Vector2d& point) const { return direction(point - position); }
  Eigen::Vector2d direction(const Eigen::Vector2d& v) const { return {v.dot(tangent), v.dot(normal)}; }
};

/// Where what is seen of a wall begins or ends.
struct SeenEnd {
  double along = 0.0;              ///< coordinate on the wall's side; m
  Eigen::Vector2d boundary_point;  ///< what the sight line passes, in the receiver's frame
  Eigen::Vector2d wall_point;      ///< where it meets the wall, in the receiver's frame
  double slide = 0.0;              ///< d along for a step of the receiver along its tangent; 0 where it is fixed
  double horizon = 0.0;            ///< where the horizon cuts: 1 at its counterclockwise end, -1 at the other

  SightTerms terms() const { return termsAt(boundary_point); }
  /// As if the boundary were on the wall.
  SightTerms wallTerms() const { return termsAt(wall_point); }

 private:
  SightTerms termsAt(const Eigen::Vector2d& p) const {
    SightTerms terms = kHorizonTerms;
    terms[kSight] = horizon;
    return horizon == 0.0 ? sightTerms(p.x(), p.y()) : terms;
  }
};

/// What is seen of one side of a segment; `last` counterclockwise of `first`.
struct SeenPiece {
  std::size_t segment = 0;
  bool is_right = false;  ///< its right side is seen
  SeenEnd first, last;
};

/// The position of a boundary point of visibleParts() that is not of the horizon.
Eigen::Vector2d boundaryPosition(const BoundaryPoint& point, std::span<const Segment> segments);

/// What a receiver sees of segments: its parts in the places of their walls, counterclockwise.
std::vector<SeenPiece> seenPieces(std::span<const VisiblePart> parts, std::span<const Segment> segments,
                                  const FlatlandFrame& receiver);

}  // namespace irradiff
