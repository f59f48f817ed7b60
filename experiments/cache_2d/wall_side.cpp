#include "experiments/cache_2d/wall_side.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

std::vector<std::size_t> segmentsOffLine(std::span<const Segment> segments, const WallSide& side) {
  double size = side.origin.cwiseAbs().maxCoeff() + side.length;
  for (const Segment& segment : segments) {
    for (const Eigen::Vector2d& vertex : segment.vertices) size = std::max(size, vertex.cwiseAbs().maxCoeff());
  }
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto isOnLine = [&](const Eigen::Vector2d& vertex) {
      return std::abs(side.local(vertex).y()) <= kOwnLineTolerance * size;
    };
    const bool is_on_line = isOnLine(segments[i].vertices[0]) && isOnLine(segments[i].vertices[1]);
    if (i != side.segment && !is_on_line) indices.push_back(i);
  }
  return indices;
}

}  // namespace irradiff
