#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

inline constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

/// A direction in the closed half circle above the horizon.
struct FlatlandDirection {
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
struct FlatlandSource {
  std::size_t index;
  Eigen::Vector2d first, last;
  std::size_t first_end;          ///< which of the segment's vertices `first` is
  int first_height, last_height;  ///< signs
  bool rises;                     ///< an end is above the horizon; otherwise only what is on the horizon counts
  bool is_end_on;                 ///< the receiver is on its line; the ends are in either order
  FlatlandDirection start, stop;  ///< its extent above the horizon

  /// Whether it takes an angle above the horizon.
  bool isBroad() const { return rises && !is_end_on; }
};

inline constexpr FlatlandDirection kHorizonStart{FlatlandDirection::Kind::kStart};
inline constexpr FlatlandDirection kHorizonStop{FlatlandDirection::Kind::kStop};

inline bool isOnHorizon(const FlatlandDirection& d) {
  return d.kind == FlatlandDirection::Kind::kStart || d.kind == FlatlandDirection::Kind::kStop;
}

/// The segments above the horizon of a receiver and the directions towards them, with all that has to be known about
/// them as signs without error.
class HalfCircle {
 public:
  /// Keeps references to the segments and to the receiver; `considered` are the indices of those that count.
  HalfCircle(std::span<const Segment> segments, std::span<const std::size_t> considered,
             const FlatlandReceiver& receiver);

  const std::vector<FlatlandSource>& sources() const { return sources_; }
  const FlatlandSource& source(std::size_t source) const { return sources_[source]; }
  /// 0 of kNobody.
  double radiance(std::size_t source) const;
  std::string nameOf(std::size_t source) const;

  /// The sign of the cross product of two sources' edges, first to last.
  int turn(std::size_t a, std::size_t b) const;

  /// Negative if a is clockwise of b, 0 if they are the same direction. An end on the horizon is kStart or kStop.
  int compare(const FlatlandDirection& a, const FlatlandDirection& b) const;

  /// Side of a point relative to a direction: positive if counterclockwise.
  int side(const FlatlandDirection& d, const Eigen::Vector2d& p) const;

  /// Whether a point is ahead (1) in a direction, behind (-1) or to the side of the receiver.
  int ahead(const FlatlandDirection& d, const Eigen::Vector2d& p) const;

  /// Whether p is before (1), on (0) or behind (-1) the line of a source.
  int before(std::size_t source, const Eigen::Vector2d& p) const;

  /// Whether the line of a is nearer (1) than that of b in direction d, as far (0) or farther (-1).
  int nearer(std::size_t a, std::size_t b, const FlatlandDirection& d) const;

  /// Of two points on one ray.
  bool isNearer(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  bool onOneLine(std::size_t a, std::size_t b) const;

 private:
  /// The line of a source: normal.w / offset is the inverse of its distance along w. The offset is positive.
  template <class Number>
  struct Line {
    Vector2<Number> normal;
    Number offset;
  };

  void addSource(std::size_t index, bool is_on_surface);
  /// A position relative to the receiver.
  template <class Number>
  Vector2<Number> relative(const Eigen::Vector2d& p) const;
  template <class Number>
  Line<Number> line(std::size_t source) const;
  /// A vector in the direction d, of any length.
  template <class Number>
  Vector2<Number> along(const FlatlandDirection& d) const;
  template <class Number>
  Vector2<Number> alongCrossing(const FlatlandDirection& d) const;
  const Eigen::Vector2d& endOf(const FlatlandDirection& d) const {
    return d.is_last ? sources_[d.source].last : sources_[d.source].first;
  }

  std::span<const Segment> segments_;
  const FlatlandReceiver& receiver_;
  std::vector<FlatlandSource> sources_;
};

}  // namespace irradiff
