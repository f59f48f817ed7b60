#include "derivatives/flatland/segment_visibility.h"

#include "derivatives/scene/bounded_number.h"
#include "derivatives/scene/exact_number.h"
#include "derivatives/scene/invalid_scene.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace irradiff {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

std::string describe(const Segment& segment, std::size_t index) {
  return "segments[" + std::to_string(index) + "] \"" + segment.name + '"';
}

/// A vector of numbers that know how far they may be trusted: BoundedNumber or ExactNumber.
template <class Number>
struct Pair {
  Number x, y;
};

template <class Number>
Pair<Number> operator-(const Pair<Number>& a, const Pair<Number>& b) {
  return {a.x - b.x, a.y - b.y};
}

template <class Number>
Number cross(const Pair<Number>& a, const Pair<Number>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class Number>
Number dot(const Pair<Number>& a, const Pair<Number>& b) {
  return a.x * b.x + a.y * b.y;
}

/// The exact sign of formula<Number>(): floating point with an error bound where that decides, else without error.
template <class Formula>
int signOf(const Formula& formula) {
  if (const BoundedNumber filtered = formula.template operator()<BoundedNumber>(); filtered.hasSign()) {
    return filtered.sign();
  }
  return formula.template operator()<ExactNumber>().sign();
}

/// A direction in the closed half circle above the horizon.
struct Direction {
  enum class Kind {
    kStart,     ///< the clockwise end of the horizon
    kStop,      ///< its counterclockwise end
    kEnd,       ///< towards the first or last end of sources[source]
    kCrossing,  ///< towards the crossing of sources[source] and sources[other]
  };
  Kind kind = Kind::kStart;
  std::size_t source = 0;
  bool is_last = false;
  std::size_t other = 0;
  int turn = 0;  ///< of a crossing: the sign of the cross product of the two edges, first to last
};

/// A segment that rises above the horizon or touches it from below, `last` counterclockwise of `first`.
struct Source {
  std::size_t index;
  Vector2d first, last;
  std::size_t first_end;          ///< which of the segment's vertices `first` is
  int first_height, last_height;  ///< signs
  bool rises;                     ///< an end is above the horizon; otherwise only what is on the horizon counts
  bool is_end_on;                 ///< the receiver is on its line; the ends are in either order
  Direction start, stop;          ///< its extent above the horizon
};

/// From `start` up to the next piece the source is front-most.
struct Piece {
  Direction start;
  std::size_t source;
};

/// What a ray meets: a source, on the clockwise side of the ray, the counterclockwise side, or both.
struct Stop {
  std::size_t source;
  bool covers_clockwise = false;
  bool covers_counterclockwise = false;
  /// The end that lies on the ray; nothing if it passes through the source, which then covers both sides. An end-on
  /// source covers neither and has two stops, one for each end.
  std::optional<std::size_t> end;
  std::size_t rank = 0;  ///< of its distance among those of the ray's stops
};

/// What is seen around one direction, from the receiver and from its neighbourhood.
struct Ray {
  std::vector<Stop> stops;  ///< by rank, up to the first that the ray passes through
  std::size_t ranks = 0;    ///< how many
  // The same radiance in all gaps between its points and beside them, from where the nearest is the most clockwise, and
  // from where it is the least.
  bool is_constant_nearest_first = false;
  bool is_constant_nearest_last = false;
  /// The radiance jumps at one fixed point, or not at all, from all of the neighbourhood.
  bool is_smooth = false;
  std::size_t point_rank = 0;  ///< where it jumps, if that is so
};

class View {
 public:
  View(std::span<const Segment> segments, std::span<const std::size_t> considered, const FlatlandReceiver& receiver)
      : segments_(segments), receiver_(receiver), is_on_surface_(considered.size() < segments.size()) {
    for (const std::size_t index : considered) {
      addSource(index);
    }
    std::vector<std::size_t> broad;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (isBroad(sources_[i])) broad.push_back(i);
    }
    pieces_ = frontMost(broad);
  }

  SegmentVisibility result() const {
    rejectVisibleTies();
    SegmentVisibility visibility;
    std::vector<Ray> rays;
    for (const Piece& piece : pieces_) {
      rays.push_back(meet(piece.start));
      report(piece.start, rays.back(), visibility);
    }
    report(kHorizonStop, meet(kHorizonStop), visibility);
    for (const Source& source : sources_) {
      if (source.is_end_on && source.rises) {
        report(source.start, meet(source.start), visibility);
      }
    }
    std::size_t whole = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (pieces_[k].source == kNobody) continue;
      const bool is_final = k + 1 == pieces_.size();
      const Source& source = sources_[pieces_[k].source];
      VisiblePart part;
      part.segment = source.index;
      part.first = boundaryPoint(source, false, pieces_[k].start, rays[k]);
      part.last = is_final ? ownPoint(source, true) : boundaryPoint(source, true, pieces_[k + 1].start, rays[k + 1]);
      part.is_whole = part.first.segment == source.index && part.first.kind != BoundaryPoint::Kind::kCrossing &&
                      part.last.segment == source.index && part.last.kind != BoundaryPoint::Kind::kCrossing;
      whole += part.is_whole ? 1 : 0;
      visibility.parts.push_back(part);
    }
    const auto broad = std::count_if(sources_.begin(), sources_.end(), isBroad);
    visibility.hides_something = whole < static_cast<std::size_t>(broad);
    return visibility;
  }

 private:
  static constexpr Direction kHorizonStart{Direction::Kind::kStart};
  static constexpr Direction kHorizonStop{Direction::Kind::kStop};

  /// Takes an angle above the horizon.
  static bool isBroad(const Source& s) { return s.rises && !s.is_end_on; }

  static bool isOnHorizon(const Direction& d) {
    return d.kind == Direction::Kind::kStart || d.kind == Direction::Kind::kStop;
  }

  // Geometry, for either kind of number.

  template <class Number>
  Pair<Number> relative(const Vector2d& p) const {
    return {Number(p.x()) - Number(receiver_.position.x()), Number(p.y()) - Number(receiver_.position.y())};
  }

  template <class Number>
  static Pair<Number> edge(const Source& s) {
    return {Number(s.last.x()) - Number(s.first.x()), Number(s.last.y()) - Number(s.first.y())};
  }

  /// The line of a source: normal.w / offset is the inverse of its distance along w. The offset is positive.
  template <class Number>
  struct Line {
    Pair<Number> normal;
    Number offset;
  };

  template <class Number>
  Line<Number> line(std::size_t source) const {
    const Source& s = sources_[source];
    const Pair<Number> e = edge<Number>(s);
    return {{e.y, -e.x}, cross(relative<Number>(s.first), e)};
  }

  /// A vector in the direction d, of any length.
  template <class Number>
  Pair<Number> along(const Direction& d) const {
    const Pair<Number> n{Number(receiver_.normal.x()), Number(receiver_.normal.y())};
    switch (d.kind) {
      case Direction::Kind::kStart:
        return {n.y, -n.x};
      case Direction::Kind::kStop:
        return {-n.y, n.x};
      case Direction::Kind::kEnd:
        return relative<Number>(endOf(d));
      case Direction::Kind::kCrossing:
        break;
    }
    // Where both lines are equally far: normal to the difference of normal/offset, on the side of the crossing.
    const Line<Number> a = line<Number>(d.source);
    const Line<Number> b = line<Number>(d.other);
    const Pair<Number> inverse{a.normal.x * b.offset - b.normal.x * a.offset,
                               a.normal.y * b.offset - b.normal.y * a.offset};
    return d.turn > 0 ? Pair<Number>{-inverse.y, inverse.x} : Pair<Number>{inverse.y, -inverse.x};
  }

  const Vector2d& endOf(const Direction& d) const {
    return d.is_last ? sources_[d.source].last : sources_[d.source].first;
  }

  // Predicates.

  int turn(std::size_t a, std::size_t b) const {
    return signOf([&]<class Number>() { return cross(edge<Number>(sources_[a]), edge<Number>(sources_[b])); });
  }

  /// Negative if a is clockwise of b, 0 if they are the same direction. An end on the horizon is kStart or kStop.
  int compare(const Direction& a, const Direction& b) const {
    using Kind = Direction::Kind;
    if (a.kind == Kind::kStart || b.kind == Kind::kStop) return a.kind == b.kind ? 0 : -1;
    if (a.kind == Kind::kStop || b.kind == Kind::kStart) return 1;
    if (a.kind == Kind::kEnd && b.kind == Kind::kEnd && endOf(a) == endOf(b)) return 0;
    return -signOf([&]<class Number>() { return cross(along<Number>(a), along<Number>(b)); });
  }

  /// Side of a point relative to a direction: positive if counterclockwise.
  int side(const Direction& d, const Vector2d& p) const {
    if (d.kind == Direction::Kind::kEnd && endOf(d) == p) return 0;
    return signOf([&]<class Number>() { return cross(along<Number>(d), relative<Number>(p)); });
  }

  /// Whether p is before (1), on (0) or behind (-1) the line of a source.
  int before(std::size_t source, const Vector2d& p) const {
    return signOf([&]<class Number>() {
      const Line<Number> a = line<Number>(source);
      return a.offset - dot(a.normal, relative<Number>(p));
    });
  }

  /// Whether the line of a is nearer (1) than that of b in direction d, as far (0) or farther (-1).
  int nearer(std::size_t a, std::size_t b, const Direction& d) const {
    if (d.kind == Direction::Kind::kEnd && d.source == a) return before(b, endOf(d));
    if (d.kind == Direction::Kind::kEnd && d.source == b) return -before(a, endOf(d));
    if (d.kind == Direction::Kind::kCrossing && std::minmax(a, b) == std::minmax(d.source, d.other)) return 0;
    return signOf([&]<class Number>() {
      const Pair<Number> w = along<Number>(d);
      const Line<Number> line_a = line<Number>(a);
      const Line<Number> line_b = line<Number>(b);
      return dot(line_a.normal, w) * line_b.offset - dot(line_b.normal, w) * line_a.offset;
    });
  }

  void addSource(std::size_t index) {
    const auto height = [&](const Vector2d& p) {
      return signOf([&]<class Number>() {
        return dot({Number(receiver_.normal.x()), Number(receiver_.normal.y())}, relative<Number>(p));
      });
    };
    const Vector2d& a = segments_[index].vertices[0];
    const Vector2d& b = segments_[index].vertices[1];
    Source s{index, a, b, 0, height(a), height(b), false, false, {}, {}};
    s.rises = s.first_height > 0 || s.last_height > 0;
    const bool touches = s.first_height == 0 || s.last_height == 0;
    // A receiver on a surface does not leave it to the side on which it would see what only touches its horizon.
    if (!s.rises && (!touches || is_on_surface_)) return;
    const int orientation = signOf([&]<class Number>() { return cross(relative<Number>(a), edge<Number>(s)); });
    if (orientation < 0) {
      std::swap(s.first, s.last);
      std::swap(s.first_height, s.last_height);
      s.first_end = 1;
    }
    const std::size_t source = sources_.size();
    s.is_end_on = orientation == 0;
    s.start = s.first_height > 0 ? Direction{Direction::Kind::kEnd, source, false} : kHorizonStart;
    s.stop = s.last_height > 0 ? Direction{Direction::Kind::kEnd, source, true} : kHorizonStop;
    sources_.push_back(s);
  }

  // The front-most sources.

  std::vector<Piece> frontMost(std::span<const std::size_t> sources) {
    if (sources.size() > 1) {
      const std::size_t half = sources.size() / 2;
      return merge(frontMost(sources.first(half)), frontMost(sources.subspan(half)));
    }
    if (sources.empty()) return {{kHorizonStart, kNobody}};
    const Source& s = sources_[sources[0]];
    std::vector<Piece> pieces;
    if (s.start.kind != Direction::Kind::kStart) pieces.push_back({kHorizonStart, kNobody});
    pieces.push_back({s.start, sources[0]});
    if (s.stop.kind != Direction::Kind::kStop) pieces.push_back({s.stop, kNobody});
    return pieces;
  }

  std::vector<Piece> merge(const std::vector<Piece>& a, const std::vector<Piece>& b) {
    std::vector<Piece> merged;
    const auto append = [&merged](const Direction& start, std::size_t source) {
      if (merged.empty() || merged.back().source != source) merged.push_back({start, source});
    };
    std::size_t i = 0;
    std::size_t j = 0;
    Direction from = kHorizonStart;
    for (;;) {
      const Direction a_end = i + 1 < a.size() ? a[i + 1].start : kHorizonStop;
      const Direction b_end = j + 1 < b.size() ? b[j + 1].start : kHorizonStop;
      const int order = compare(a_end, b_end);
      // Of equal directions the one towards an end is the cheaper to compute with.
      const Direction to = order < 0 || (order == 0 && a_end.kind != Direction::Kind::kCrossing) ? a_end : b_end;
      appendNearer(a[i].source, b[j].source, from, to, append);
      if (to.kind == Direction::Kind::kStop) return merged;
      i += order <= 0 ? 1 : 0;
      j += order >= 0 ? 1 : 0;
      from = to;
    }
  }

  template <class Append>
  void appendNearer(std::size_t a, std::size_t b, const Direction& from, const Direction& to, const Append& append) {
    if (a == kNobody || b == kNobody) {
      append(from, a == kNobody ? b : a);
      return;
    }
    const int at_start = nearer(a, b, from);
    const int at_end = nearer(a, b, to);
    if (at_start * at_end < 0) {
      append(from, at_start > 0 ? a : b);
      append(Direction{Direction::Kind::kCrossing, a, false, b, turn(a, b)}, at_end > 0 ? a : b);
    } else if (at_start == 0 && at_end == 0) {
      append(from, std::min(a, b));
      if (radiance(a) != radiance(b)) ties_.emplace_back(std::min(a, b), std::max(a, b));
    } else {
      append(from, at_start + at_end > 0 ? a : b);
    }
  }

  double radiance(std::size_t source) const {
    return source == kNobody ? 0.0 : segments_[sources_[source].index].radiance;
  }

  std::string nameOf(std::size_t source) const {
    const std::size_t index = sources_[source].index;
    return describe(segments_[index], index);
  }

  /// Segments that overlap behind others may differ in radiance: only what is seen matters.
  void rejectVisibleTies() const {
    for (const auto& [a, b] : ties_) {
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const std::size_t front = pieces_[k].source;
        if (front == kNobody || !onOneLine(front, a)) continue;
        Direction from = pieces_[k].start;
        Direction to = k + 1 < pieces_.size() ? pieces_[k + 1].start : kHorizonStop;
        for (const std::size_t source : {a, b}) {
          if (compare(from, sources_[source].start) < 0) from = sources_[source].start;
          if (compare(sources_[source].stop, to) < 0) to = sources_[source].stop;
        }
        if (compare(from, to) < 0) {
          throw InvalidScene(nameOf(a) + " and " + nameOf(b) +
                             " lie on one line and overlap in view, but their radiances differ: which of them is seen "
                             "is not defined");
        }
      }
    }
  }

  bool onOneLine(std::size_t a, std::size_t b) const {
    return before(a, sources_[b].first) == 0 && before(a, sources_[b].last) == 0;
  }

  // What is seen around a direction.

  /// The sources on a ray from the receiver, up to the first that the ray passes through, and what they let see.
  Ray meet(const Direction& d) const {
    std::vector<Stop> points;
    std::vector<Stop> crossed;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const Source& s = sources_[i];
      if (!s.rises) {
        addTouching(d, i, points);
        continue;
      }
      if (s.is_end_on) {
        if (!isOnHorizon(d) && side(d, s.first) == 0) {
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
    Ray ray;
    for (const Stop& stop : points) {
      if (crossed.empty() || before(crossed[0].source, pointOf(stop)) >= 0) ray.stops.push_back(stop);
    }
    std::stable_sort(ray.stops.begin(), ray.stops.end(),
                     [this](const Stop& a, const Stop& b) { return isNearer(pointOf(a), pointOf(b)); });
    for (std::size_t k = 1; k < ray.stops.size(); ++k) {
      ray.stops[k].rank = ray.stops[k - 1].rank + (isNearer(pointOf(ray.stops[k - 1]), pointOf(ray.stops[k])) ? 1 : 0);
    }
    for (Stop& stop : crossed) {
      if (!ray.stops.empty()) {
        const Stop& farthest = ray.stops.back();
        // Its own rank may be shared with ends that lie on it.
        stop.rank = farthest.end ? farthest.rank + (before(stop.source, pointOf(farthest)) > 0 ? 1 : 0) : farthest.rank;
      }
      ray.stops.push_back(stop);
    }
    ray.ranks = ray.stops.empty() ? 0 : ray.stops.back().rank + 1;
    judge(ray);
    return ray;
  }

  /// What touches the horizon from below is on its outer side, or along it.
  void addTouching(const Direction& d, std::size_t source, std::vector<Stop>& points) const {
    if (!isOnHorizon(d)) return;
    const Source& s = sources_[source];
    const bool is_start = d.kind == Direction::Kind::kStart;
    if (s.is_end_on) {
      const int along_ray = signOf([&]<class Number>() { return dot(along<Number>(d), relative<Number>(s.first)); });
      if (along_ray <= 0) return;
      points.push_back({source, false, false, 0});
      points.push_back({source, false, false, 1});
    } else if (is_start && s.last_height == 0) {
      points.push_back({source, true, false, 1});
    } else if (!is_start && s.first_height == 0) {
      points.push_back({source, false, true, 0});
    }
  }

  /// `extent` is the direction of that end, which is the horizon's where the end is on it or below.
  int sideOfEnd(const Direction& d, const Vector2d& end, int height, const Direction& extent) const {
    using Kind = Direction::Kind;
    if (isOnHorizon(d)) {
      const int outward = d.kind == Kind::kStart ? -1 : 1;
      // Everything above the horizon is on the inner side, what is cut there reaches the outer.
      if (extent.kind != d.kind) return -outward;
      return height == 0 ? 0 : outward;
    }
    if (height < 0) return extent.kind == Kind::kStart ? -1 : 1;
    return side(d, end);
  }

  const Vector2d& pointOf(const Stop& stop) const {
    return *stop.end == 0 ? sources_[stop.source].first : sources_[stop.source].last;
  }

  /// Of two points on one ray.
  bool isNearer(const Vector2d& a, const Vector2d& b) const {
    return a != b && signOf([&]<class Number>() {
                       return dot(relative<Number>(a), relative<Number>(b) - relative<Number>(a));
                     }) > 0;
  }

  void keepNearest(const Direction& d, const Stop& stop, std::vector<Stop>& crossed) const {
    const int order = crossed.empty() ? 0 : nearer(stop.source, crossed[0].source, d);
    if (order > 0) crossed.clear();
    if (order >= 0) crossed.push_back(stop);
  }

  /// Compares what is seen from either side of the ray. Seen from a receiver that has moved clockwise or
  /// counterclockwise by an infinitesimal amount, the points of the ray fan out in the order of their distances, and
  /// between two of them opens a gap. Gap j is between ranks j - 1 and j.
  void judge(Ray& ray) const {
    std::vector<double> nearest_first;  // the nearest point is the most clockwise
    std::vector<double> nearest_last;
    bool is_ambiguous = false;
    for (std::size_t gap = 0; gap <= ray.ranks; ++gap) {
      nearest_first.push_back(radiance(frontInGap(ray, gap, true, is_ambiguous)));
      nearest_last.push_back(radiance(frontInGap(ray, gap, false, is_ambiguous)));
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
  std::size_t frontInGap(const Ray& ray, std::size_t gap, bool is_nearest_clockwise, bool& is_ambiguous) const {
    std::size_t front = kNobody;
    std::size_t front_rank = 0;  // doubled, so that end-on sources fit between ranks
    bool is_tied = false;
    for (std::size_t k = 0; k < ray.stops.size(); ++k) {
      const Stop& stop = ray.stops[k];
      const bool is_counterclockwise = is_nearest_clockwise == (stop.rank < gap);
      std::size_t rank = 2 * stop.rank;
      if (sources_[stop.source].is_end_on) {
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
      } else if (order == 0 && radiance(stop.source) != radiance(front)) {
        is_tied = true;
      }
    }
    is_ambiguous = is_ambiguous || is_tied;
    return front;
  }

  /// Whether stop k is the near end of an end-on source whose far end is behind the gap.
  static bool spansGap(const Ray& ray, std::size_t k, std::size_t gap) {
    if (ray.stops[k].rank >= gap) return false;
    const std::size_t source = ray.stops[k].source;
    // A far end that is hidden is not among the stops: then the source reaches all gaps behind its near end.
    for (const Stop& stop : ray.stops) {
      if (stop.source == source && stop.end != ray.stops[k].end) return stop.rank >= gap;
    }
    return true;
  }

  /// Of two sources through one point, on one side of it: whether a is in front (1) or b (-1); 0 on one line.
  int inFront(std::size_t a, std::size_t b, bool is_counterclockwise) const {
    return is_counterclockwise ? -turn(a, b) : turn(a, b);
  }

  // Results.

  void report(const Direction& d, const Ray& ray, SegmentVisibility& visibility) const {
    if (isOnHorizon(d)) {
      // A move against the normal lifts the points over the horizon, the nearest most; a move along it hides them all.
      const bool is_start = d.kind == Direction::Kind::kStart;
      const bool is_constant = is_start ? ray.is_constant_nearest_last : ray.is_constant_nearest_first;
      if (!is_constant && visibility.no_hessian.empty()) {
        visibility.no_hessian =
            nameOf(ray.stops[0].source) +
            " has an end on the receiver's horizon: the second derivative along the normal is one-sided";
      }
    } else if (!ray.is_smooth && visibility.no_gradient.empty()) {
      visibility.no_gradient = eventText(ray);
    }
  }

  std::string eventText(const Ray& ray) const {
    for (const Stop& stop : ray.stops) {
      if (sources_[stop.source].is_end_on) {
        return nameOf(stop.source) + " is seen end-on: the receiver lies on its line";
      }
    }
    const Stop& near = ray.stops.front();
    const auto far = std::find_if(ray.stops.begin(), ray.stops.end(), [](const Stop& stop) { return stop.rank > 0; });
    return nameOf(near.source) + " has an end in line with " + (far->end ? "an end" : "a crossing") + " of " +
           nameOf(far->source) + ": what is seen between them depends on where the receiver moves";
  }

  BoundaryPoint ownPoint(const Source& source, bool is_last) const {
    const int height = is_last ? source.last_height : source.first_height;
    if (height < 0) return {BoundaryPoint::Kind::kHorizon, source.index};
    return {BoundaryPoint::Kind::kEnd, source.index, is_last ? 1 - source.first_end : source.first_end};
  }

  /// The point at which what is seen of a source begins or ends in direction d: its own end if the radiance jumps
  /// there, or if no point is the one.
  BoundaryPoint boundaryPoint(const Source& source, bool is_last, const Direction& d, const Ray& ray) const {
    if (d.kind == Direction::Kind::kStart) return ownPoint(source, is_last);
    std::optional<BoundaryPoint> end;
    std::optional<std::size_t> through;
    BoundaryPoint crossing{BoundaryPoint::Kind::kCrossing};
    for (const Stop& stop : ray.stops) {
      const Source& met = sources_[stop.source];
      const bool is_own = met.index == source.index && stop.end && (*stop.end == 1) == is_last;
      if (is_own && (!ray.is_smooth || stop.rank == ray.point_rank)) return ownPoint(source, is_last);
      if (stop.rank != ray.point_rank) continue;
      if (stop.end) {
        if (!end) end = ownPoint(met, *stop.end == 1);
      } else if (!through) {
        through = stop.source;
        crossing.segment = met.index;
      } else if (turn(*through, stop.source) != 0) {
        crossing.other = met.index;
      }
    }
    return end ? *end : crossing;
  }

  std::span<const Segment> segments_;
  const FlatlandReceiver& receiver_;
  bool is_on_surface_;
  std::vector<Source> sources_;
  std::vector<Piece> pieces_;
  std::vector<std::pair<std::size_t, std::size_t>> ties_;  ///< of different radiance
};

}  // namespace

SegmentVisibility visibleParts(std::span<const Segment> segments, std::span<const std::size_t> considered,
                               const FlatlandReceiver& receiver) {
  return View(segments, considered, receiver).result();
}

}  // namespace irradiff
