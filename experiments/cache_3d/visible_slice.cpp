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
  if (!parts.empty() && parts.back().segment == part.segment && parts.back().end == part.begin) {
    parts.back().end = part.end;
  } else {
    parts.push_back(part);
  }
}

/// u of the direction in which two lines are equally far, if it is between begin and end.
double crossing(const SliceSegment& one, const SliceSegment& other, double begin, double end) {
  const Eigen::Vector2d difference = one.inverse - other.inverse;
  const double across = difference[1] * difference[1];
  return std::clamp(across / (across + difference[0] * difference[0]), begin, end);
}

/// No segment begins or ends between `begin` and `end`.
void divide(const std::vector<SliceSegment>& segments, double begin, double end, int depth,
            std::vector<VisiblePart>& parts) {
  if (!(end - begin > kShortestPart)) return;
  const Eigen::Vector2d first = sliceDirection(begin);
  const Eigen::Vector2d last = sliceDirection(end);
  const double middle = 0.5 * (begin + end);
  std::size_t nearest = segments.size();
  double nearest_sum = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].begin > middle || segments[i].end < middle) continue;
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
      if (other.begin > middle || other.end < middle) continue;
      const Eigen::Vector2d difference = other.inverse - chosen.inverse;
      const double rounding = kAsNear * chosen.inverse.norm();
      if (difference.dot(first) <= rounding && difference.dot(last) <= rounding) continue;
      const double cut = crossing(other, chosen, begin, end);
      if (cut - begin <= kShortestPart || end - cut <= kShortestPart) continue;
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
  thread_local std::vector<double> ends;
  ends.clear();
  for (const SliceSegment& segment : segments) {
    ends.push_back(segment.begin);
    ends.push_back(segment.end);
  }
  std::ranges::sort(ends);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) divide(segments, ends[i], ends[i + 1], 0, parts);
}

}  // namespace irradiff
