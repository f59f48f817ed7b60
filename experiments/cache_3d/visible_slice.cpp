#include "experiments/cache_3d/visible_slice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {

namespace {

/// Segments that are nearer by less than this share are as near: they meet there.
constexpr double kAsNear = 1e-11;
/// Halvings of one stretch by crossings; more than a room of polygons that pass through each other has in a slice.
constexpr int kMostCrossings = 32;

void append(std::vector<VisiblePart>& parts, const VisiblePart& part) {
  if (!parts.empty() && parts.back().segment == part.segment && parts.back().end.u == part.begin.u) {
    parts.back().end = part.end;
  } else {
    parts.push_back(part);
  }
}

/// The direction in which two lines are equally far, D.w = 0 with D the difference of their inverses. u = D_h^2/|D|^2.
SliceEnd crossing(const SliceSegment& one, const SliceSegment& other) {
  const Eigen::Vector2d d = one.inverse - other.inverse;
  const double square = d.squaredNorm();
  const Eigen::Vector2d motion_s = one.inverse[0] * one.plane - other.inverse[0] * other.plane;
  const Eigen::Vector2d motion_h = one.inverse[1] * one.plane - other.inverse[1] * other.plane;
  return {d[1] * d[1] / square, 2.0 * d[0] * d[1] * (d[0] * motion_h - d[1] * motion_s) / (square * square)};
}

/// No segment begins or ends between `begin` and `end`.
void divide(const std::vector<SliceSegment>& segments, const SliceEnd& begin, const SliceEnd& end, int depth,
            std::vector<VisiblePart>& parts) {
  if (!(end.u - begin.u > kShortestPart)) return;
  const Eigen::Vector2d first = sliceDirection(begin.u);
  const Eigen::Vector2d last = sliceDirection(end.u);
  const double middle = 0.5 * (begin.u + end.u);
  const auto isThere = [middle](const SliceSegment& s) { return s.begin.u <= middle && s.end.u >= middle; };
  std::size_t nearest = segments.size();
  double nearest_sum = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!isThere(segments[i])) continue;
    const double sum = segments[i].inverse.dot(first + last);
    if (sum > nearest_sum) {
      nearest = i;
      nearest_sum = sum;
    }
  }
  if (nearest == segments.size()) return;
  // Inverse distances are linear in the direction: what is as near at both ends is as near between them.
  const SliceSegment& chosen = segments[nearest];
  if (depth < kMostCrossings) {
    for (const SliceSegment& other : segments) {
      if (!isThere(other)) continue;
      const Eigen::Vector2d difference = other.inverse - chosen.inverse;
      const double rounding = kAsNear * chosen.inverse.norm();
      if (difference.dot(first) <= rounding && difference.dot(last) <= rounding) continue;
      const SliceEnd cut = crossing(other, chosen);
      if (!(cut.u - begin.u > kShortestPart && end.u - cut.u > kShortestPart)) continue;
      divide(segments, begin, cut, depth + 1, parts);
      divide(segments, cut, end, depth + 1, parts);
      return;
    }
  }
  append(parts, {nearest, begin, end});
}

}  // namespace

void findVisibleParts(const std::vector<SliceSegment>& segments, std::vector<VisiblePart>& parts) {
  parts.clear();
  thread_local std::vector<SliceEnd> ends;
  ends.clear();
  for (const SliceSegment& segment : segments) {
    ends.push_back(segment.begin);
    ends.push_back(segment.end);
  }
  std::ranges::sort(ends, {}, &SliceEnd::u);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) divide(segments, ends[i], ends[i + 1], 0, parts);
}

}  // namespace irradiff
