#include "experiments/cache_2d/seen_piece.h"

#include <algorithm>
#include <optional>

namespace irradiff {
namespace {

using Kind = BoundaryPoint::Kind;

double crossOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where on its own wall a boundary point is fixed; nothing if it is in front of the wall.
std::optional<double> fixedAlong(const BoundaryPoint& point, const Eigen::Vector2d& position, const Segment& wall,
                                 const WallSide& side) {
  if (position == side.origin) return 0.0;
  if (position == wall.vertices[0] || position == wall.vertices[1]) return side.length;
  const bool is_own = point.segment == side.segment || (point.kind == Kind::kCrossing && point.other == side.segment);
  if (is_own) return side.local(position).x();
  return std::nullopt;
}

SeenEnd seenEnd(const BoundaryPoint& point, bool is_last, std::span<const Segment> segments, const WallSide& side,
                const FlatlandFrame& receiver) {
  const Eigen::Vector2d start = receiver.local(side.origin);
  const Eigen::Vector2d step = receiver.direction(side.tangent);
  SeenEnd end;
  if (point.kind == Kind::kHorizon) {
    end.horizon = is_last ? 1.0 : -1.0;
    end.along = -start.y() / step.y();
  } else {
    const Eigen::Vector2d position = boundaryPosition(point, segments);
    end.boundary_point = receiver.local(position);
    if (const auto fixed = fixedAlong(point, position, segments[side.segment], side)) {
      end.along = *fixed;
    } else {
      // The sight line past p meets the wall start + u step where p x (start + u step) = 0. When the receiver moves by
      // ds, p and start move by -ds along the tangent: du/ds = (p_h - wall_h)/(p_h step_x - p_x step_h).
      const Eigen::Vector2d& p = end.boundary_point;
      const double turn = crossOf(p, step);
      end.along = -crossOf(p, start) / turn;
      end.slide = (start.y() + end.along * step.y() - p.y()) / turn;
    }
  }
  end.along = std::clamp(end.along, 0.0, side.length);
  end.wall_point = start + end.along * step;
  return end;
}

}  // namespace

Eigen::Vector2d boundaryPosition(const BoundaryPoint& point, std::span<const Segment> segments) {
  const std::array<Eigen::Vector2d, 2>& a = segments[point.segment].vertices;
  if (point.kind == Kind::kEnd) return a[point.end];
  const std::array<Eigen::Vector2d, 2>& b = segments[point.other].vertices;
  const Eigen::Vector2d edge = a[1] - a[0];
  return a[0] + crossOf(b[0] - a[0], b[1] - b[0]) / crossOf(edge, b[1] - b[0]) * edge;
}

std::vector<SeenPiece> seenPieces(std::span<const VisiblePart> parts, std::span<const Segment> segments,
                                  const FlatlandFrame& receiver) {
  std::vector<SeenPiece> pieces;
  for (const VisiblePart& part : parts) {
    SeenPiece piece{part.segment, false, {}, {}};
    WallSide side = wallSide(segments[part.segment], part.segment, false);
    const double height = side.local(receiver.position).y();
    if (height == 0.0) continue;
    if (height < 0.0) {
      piece.is_right = true;
      side = wallSide(segments[part.segment], part.segment, true);
    }
    piece.first = seenEnd(part.first, false, segments, side, receiver);
    piece.last = seenEnd(part.last, true, segments, side, receiver);
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace irradiff
