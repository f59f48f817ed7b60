#include "experiments/cache_2d/flatland_reprojection.h"

#include <algorithm>

namespace irradiff {

FlatlandReprojection::FlatlandReprojection(const LitRoom& room, std::size_t side, const Eigen::Vector2d& position)
    : room_(room), frame_(frameOn(room.side(side), position)) {
  const auto world = [this](const Eigen::Vector2d& local) -> Eigen::Vector2d {
    return frame_.position + local.x() * frame_.tangent + local.y() * frame_.normal;
  };
  for (const SeenPiece& piece : seenFrom(room, side, position)) {
    const std::size_t seen = room.sideOf(piece.segment, piece.is_right);
    const Eigen::Vector2d first = room.side(seen).point(piece.first.along);
    const Eigen::Vector2d last = room.side(seen).point(piece.last.along);
    if (piece.first.slide != 0.0) {
      addSegment(world(piece.first.boundary_point), first,
                 {kGap, room.radianceBeside(seen, piece.first.along, false).irradiance});
    }
    addSegment(first, last, {seen, 0.0, piece.first.along});
    if (piece.last.slide != 0.0) {
      addSegment(last, world(piece.last.boundary_point),
                 {kGap, room.radianceBeside(seen, piece.last.along, true).irradiance});
    }
  }
}

void FlatlandReprojection::addSegment(const Eigen::Vector2d& first, const Eigen::Vector2d& last, const Seen& seen) {
  if (first == last) return;
  all_.push_back(segments_.size());
  segments_.push_back({"", {first, last}, 0.0});
  seen_.push_back(seen);
}

bool FlatlandReprojection::isOnSegment(const Eigen::Vector2d& position) const {
  return std::ranges::any_of(segments_, [&](const Segment& segment) {
    const WallSide side = wallSide(segment, 0, false);
    const Eigen::Vector2d local = side.local(position);
    const double touching = kOwnLineTolerance * (position.norm() + side.length);
    return std::abs(local.y()) <= touching && local.x() >= -touching && local.x() <= side.length + touching;
  });
}

double FlatlandReprojection::irradiance(double step) const {
  const FlatlandFrame frame{frame_.position + step * frame_.tangent, frame_.tangent, frame_.normal};
  double sum = 0.0;
  if (isOnSegment(frame.position)) return sum;
  const SegmentVisibility visibility = visibleParts(segments_, all_, {frame.position, frame.normal});
  for (const SeenPiece& piece : seenPieces(visibility.parts, segments_, frame)) {
    const Seen& seen = seen_[piece.segment];
    if (piece.is_right) continue;
    if (seen.side == kGap) {
      sum += seen.radiance * (piece.last.terms()[kSight] - piece.first.terms()[kSight]);
    } else {
      SeenEnd first = piece.first;
      SeenEnd last = piece.last;
      first.along = std::min(first.along + seen.along, room_.side(seen.side).length);
      last.along = std::min(last.along + seen.along, room_.side(seen.side).length);
      sum += pieceIrradiance(room_, seen.side, frame, first, last);
    }
  }
  return sum;
}

}  // namespace irradiff
