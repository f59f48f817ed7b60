#include "derivatives/flatland/sight_ray.h"

#include <algorithm>
#include <functional>

namespace irradiff {
namespace {

/// Finds what rays meet.
class RaySurvey {
 public:
  explicit RaySurvey(const HalfCircle& half_circle) : half_circle_(half_circle) {}

  SightRay meet(const FlatlandDirection& d) const;

 private:
  void addTouching(const FlatlandDirection& d, std::size_t source, std::vector<RayStop>& points) const;
  int sideOfEnd(const FlatlandDirection& d, const Eigen::Vector2d& end, int height,
                const FlatlandDirection& extent) const;
  const Eigen::Vector2d& pointOf(const RayStop& stop) const;
  void keepNearest(const FlatlandDirection& d, const RayStop& stop, std::vector<RayStop>& crossed) const;
  void judge(SightRay& ray) const;
  std::size_t frontInGap(const SightRay& ray, std::size_t gap, bool is_nearest_clockwise, bool& is_ambiguous) const;
  int inFront(std::size_t a, std::size_t b, bool is_counterclockwise) const;

  const HalfCircle& half_circle_;
};

/// Whether stop k is the near end of an end-on source whose far end is behind the gap.
bool spansGap(const SightRay& ray, std::size_t k, std::size_t gap) {
  if (ray.stops[k].rank >= gap) return false;
  const std::size_t source = ray.stops[k].source;
  // A far end that is hidden is not among the stops: then the source reaches all gaps behind its near end.
  for (const RayStop& stop : ray.stops) {
    if (stop.source == source && stop.end != ray.stops[k].end) return stop.rank >= gap;
  }
  return true;
}

SightRay RaySurvey::meet(const FlatlandDirection& d) const {
  std::vector<RayStop> points;
  std::vector<RayStop> crossed;
  for (std::size_t i = 0; i < half_circle_.sources().size(); ++i) {
    const FlatlandSource& s = half_circle_.source(i);
    if (!s.rises) {
      addTouching(d, i, points);
      continue;
    }
    if (s.is_end_on) {
      if (!isOnHorizon(d) && half_circle_.side(d, s.first) == 0) {
        points.push_back({i, false, false, 0});
        points.push_back({i, false, false, 1});
      }
      continue;
    }
    // On the horizon and above it alike: 0 if the end lies on the ray itself.
    const int first = sideOfEnd(d, s.first, s.first_height, s.start);
    const int last = sideOfEnd(d, s.last, s.last_height, s.stop);
    if (first < 0 && last > 0) {
      keepNearest(d, {i, true, true, std::nullopt}, crossed);
    } else if (first == 0) {
      points.push_back({i, false, true, 0});
    } else if (last == 0) {
      points.push_back({i, true, false, 1});
    }
  }
  SightRay ray;
  for (const RayStop& stop : points) {
    if (crossed.empty() || half_circle_.before(crossed[0].source, pointOf(stop)) >= 0) ray.stops.push_back(stop);
  }
  std::stable_sort(ray.stops.begin(), ray.stops.end(), [this](const RayStop& a, const RayStop& b) {
    return half_circle_.isNearer(pointOf(a), pointOf(b));
  });
  for (std::size_t k = 1; k < ray.stops.size(); ++k) {
    ray.stops[k].rank =
        ray.stops[k - 1].rank + (half_circle_.isNearer(pointOf(ray.stops[k - 1]), pointOf(ray.stops[k])) ? 1 : 0);
  }
  for (RayStop& stop : crossed) {
    if (!ray.stops.empty()) {
      const RayStop& farthest = ray.stops.back();
      // Its own rank may be shared with ends that lie on it.
      stop.rank = farthest.end ? farthest.rank + (half_circle_.before(stop.source, pointOf(farthest)) > 0 ? 1 : 0)
                               : farthest.rank;
    }
    ray.stops.push_back(stop);
  }
  ray.ranks = ray.stops.empty() ? 0 : ray.stops.back().rank + 1;
  judge(ray);
  return ray;
}

/// What touches the horizon from below is on its outer side, or along it.
void RaySurvey::addTouching(const FlatlandDirection& d, std::size_t source, std::vector<RayStop>& points) const {
  if (!isOnHorizon(d)) return;
  const FlatlandSource& s = half_circle_.source(source);
  const bool is_start = d.kind == FlatlandDirection::Kind::kStart;
  if (s.is_end_on) {
    if (half_circle_.ahead(d, s.first) <= 0) return;
    points.push_back({source, false, false, 0});
    points.push_back({source, false, false, 1});
  } else if (is_start && s.last_height == 0) {
    points.push_back({source, true, false, 1});
  } else if (!is_start && s.first_height == 0) {
    points.push_back({source, false, true, 0});
  }
}

/// `extent` is the direction of that end, which is the horizon's where the end is on it or below.
int RaySurvey::sideOfEnd(const FlatlandDirection& d, const Eigen::Vector2d& end, int height,
                         const FlatlandDirection& extent) const {
  using Kind = FlatlandDirection::Kind;
  if (isOnHorizon(d)) {
    const int outward = d.kind == Kind::kStart ? -1 : 1;
    // Everything above the horizon is on the inner side, what is cut there reaches the outer.
    if (extent.kind != d.kind) return -outward;
    return height == 0 ? 0 : outward;
  }
  if (height < 0) return extent.kind == Kind::kStart ? -1 : 1;
  return half_circle_.side(d, end);
}

const Eigen::Vector2d& RaySurvey::pointOf(const RayStop& stop) const {
  return *stop.end == 0 ? half_circle_.source(stop.source).first : half_circle_.source(stop.source).last;
}

void RaySurvey::keepNearest(const FlatlandDirection& d, const RayStop& stop, std::vector<RayStop>& crossed) const {
  const int order = crossed.empty() ? 0 : half_circle_.nearer(stop.source, crossed[0].source, d);
  if (order > 0) crossed.clear();
  if (order >= 0) crossed.push_back(stop);
}

/// Compares what is seen from either side of the ray. Seen from a receiver that has moved clockwise or
/// counterclockwise by an infinitesimal amount, the points of the ray fan out in the order of their distances, and
/// between two of them opens a gap. Gap j is between ranks j - 1 and j.
void RaySurvey::judge(SightRay& ray) const {
  std::vector<double> nearest_first;  // the nearest point is the most clockwise
  std::vector<double> nearest_last;
  bool is_ambiguous = false;
  for (std::size_t gap = 0; gap <= ray.ranks; ++gap) {
    nearest_first.push_back(half_circle_.radiance(frontInGap(ray, gap, true, is_ambiguous)));
    nearest_last.push_back(half_circle_.radiance(frontInGap(ray, gap, false, is_ambiguous)));
  }
  if (is_ambiguous) return;
  const double clockwise = nearest_first.front();
  const double counterclockwise = nearest_first.back();
  const auto jumpsAt = [&](std::size_t rank) {
    for (std::size_t gap = 0; gap <= ray.ranks; ++gap) {
      if (nearest_first[gap] != (gap <= rank ? clockwise : counterclockwise)) return false;
      if (nearest_last[gap] != (gap <= rank ? counterclockwise : clockwise)) return false;
    }
    return true;
  };
  for (std::size_t rank = 0; rank < ray.ranks && !ray.is_smooth; ++rank) {
    ray.is_smooth = jumpsAt(rank);
    ray.point_rank = ray.is_smooth ? rank : 0;
  }
  ray.is_smooth = ray.is_smooth || ray.ranks == 0;
  const auto isConstant = [](const std::vector<double>& radiances) {
    return std::adjacent_find(radiances.begin(), radiances.end(), std::not_equal_to<>()) == radiances.end();
  };
  ray.is_constant_nearest_first = isConstant(nearest_first);
  ray.is_constant_nearest_last = isConstant(nearest_last);
}

/// The front-most in a gap. Sets `is_ambiguous` if several on one line are, of different radiance.
std::size_t RaySurvey::frontInGap(const SightRay& ray, std::size_t gap, bool is_nearest_clockwise,
                                  bool& is_ambiguous) const {
  std::size_t front = kNobody;
  std::size_t front_rank = 0;  // doubled, so that end-on sources fit between ranks
  bool is_tied = false;
  for (std::size_t k = 0; k < ray.stops.size(); ++k) {
    const RayStop& stop = ray.stops[k];
    const bool is_counterclockwise = is_nearest_clockwise == (stop.rank < gap);
    std::size_t rank = 2 * stop.rank;
    if (half_circle_.source(stop.source).is_end_on) {
      if (!spansGap(ray, k, gap)) continue;
      rank = 2 * gap - 1;
    } else if (!(is_counterclockwise ? stop.covers_counterclockwise : stop.covers_clockwise)) {
      continue;
    }
    int order = 1;
    if (front != kNobody) {
      order = rank == front_rank ? inFront(stop.source, front, is_counterclockwise) : (rank < front_rank ? 1 : -1);
    }
    if (order > 0) {
      front = stop.source;
      front_rank = rank;
      is_tied = false;
    } else if (order == 0 && half_circle_.radiance(stop.source) != half_circle_.radiance(front)) {
      is_tied = true;
    }
  }
  is_ambiguous = is_ambiguous || is_tied;
  return front;
}

/// Of two sources through one point, on one side of it: whether a is in front (1) or b (-1); 0 on one line.
int RaySurvey::inFront(std::size_t a, std::size_t b, bool is_counterclockwise) const {
  return is_counterclockwise ? -half_circle_.turn(a, b) : half_circle_.turn(a, b);
}

}  // namespace

SightRay rayAlong(const HalfCircle& half_circle, const FlatlandDirection& direction) {
  return RaySurvey(half_circle).meet(direction);
}

}  // namespace irradiff
