#include "experiments/cache_2d/wall_receivers.h"

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

/// Places at which a side without direct light is tried for light that is reflected.
constexpr std::size_t kTrials = 256;
/// A receiver so close to a segment, as a share of its side's length, is on it.
constexpr double kTouching = 1e-12;

bool isOnOther(const LitRoom& room, std::size_t side, const Eigen::Vector2d& position) {
  return std::ranges::any_of(room.segmentsBefore(side), [&](std::size_t segment) {
    const WallSide& other = room.side(room.sideOf(segment, false));
    const Eigen::Vector2d local = other.local(position);
    const double touching = kTouching * room.side(side).length;
    return std::abs(local.y()) <= touching && local.x() >= -touching && local.x() <= other.length + touching;
  });
}

bool isLit(const LitRoom& room, std::size_t side) {
  if (room.light(side).brightest() > room.darkness()) return true;
  for (std::size_t i = 0; i < kTrials; ++i) {
    const double along = room.side(side).length * (static_cast<double>(i) + 0.5) / static_cast<double>(kTrials);
    const Eigen::Vector2d position = room.side(side).point(along);
    if (!isOnOther(room, side, position) && gather(room, side, position).irradiance > 0.0) return true;
  }
  return false;
}

bool areOnOneLine(const WallSide& a, const WallSide& b) {
  const double touching = kTouching * (a.length + b.length);
  return a.normal.dot(b.normal) > 0.0 && std::abs(a.local(b.origin).y()) <= touching &&
         std::abs(a.local(b.point(b.length)).y()) <= touching;
}

}  // namespace

WallReceivers::WallReceivers(const LitRoom& room, std::size_t count) {
  std::vector<std::size_t> lit;
  double length = 0.0;
  for (std::size_t side = 0; side < 2 * room.segments().size(); ++side) {
    sides.push_back(room.side(side));
    if (room.reflectance(side) == 0.0 || !isLit(room, side)) continue;
    lit.push_back(side);
    length += sides[side].length;
  }
  std::vector<std::size_t> line_sides;
  for (const std::size_t side : lit) {
    const double share = sides[side].length / length * static_cast<double>(count);
    const auto side_cells = static_cast<std::size_t>(std::max(1L, std::lround(share)));
    const double cell_length = sides[side].length / static_cast<double>(side_cells);
    const auto same =
        std::ranges::find_if(line_sides, [&](std::size_t s) { return areOnOneLine(sides[s], sides[side]); });
    const auto line = static_cast<std::size_t>(same - line_sides.begin());
    if (same == line_sides.end()) {
      line_sides.push_back(side);
      lines.emplace_back();
    }
    for (std::size_t i = 0; i < side_cells; ++i) {
      const Eigen::Vector2d position = sides[side].point(cell_length * (static_cast<double>(i) + 0.5));
      const std::size_t cell = cells++;
      if (isOnOther(room, side, position)) continue;
      lines[line].push_back(receivers.size());
      receivers.push_back({side, cell, cell_length, position, line, 0, sides[line_sides[line]].local(position).x()});
    }
  }
  for (std::vector<std::size_t>& line : lines) {
    std::ranges::stable_sort(line, {}, [this](std::size_t i) { return receivers[i].along_line; });
    for (std::size_t rank = 0; rank < line.size(); ++rank) receivers[line[rank]].rank = rank;
  }
}

}  // namespace irradiff
