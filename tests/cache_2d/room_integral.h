#pragma once

#include "experiments/cache_2d/flatland_room.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace irradiff {

/// Irradiance in a flatland room from its definition, by casting rays in long double: the integral of L cos over
/// directions, between the directions at which what is seen changes. Shares no code with experiments/cache_2d.
class RoomIntegral {
 public:
  using Real = long double;
  using Point = Eigen::Matrix<Real, 2, 1>;

  explicit RoomIntegral(const FlatlandRoom& room);

  /// Numbers of the segments on the line through a place, which whoever is there does not see.
  std::vector<std::size_t> onLine(const Point& position, const Point& normal) const;

  Real direct(const Point& position, const Point& normal) const;
  /// One bounce; to about 1e-17 of the emitters. `behind` are the segments that are not seen.
  Real indirect(const Point& position, const Point& normal, const std::vector<std::size_t>& behind) const;
  Real indirect(const Point& position, const Point& normal) const {
    return indirect(position, normal, onLine(position, normal));
  }
  /// 1/2 the integral of cos/r.
  Real inverseDistance(const Point& position, const Point& normal) const;

 private:
  struct Window {
    Real from, to;  ///< angles from the normal, clockwise
    std::size_t segment;
  };

  Point vertex(std::size_t segment, std::size_t end) const {
    return room_.segments[segment].vertices[end].cast<Real>();
  }
  Point towards(const Point& normal, Real angle) const;
  /// Distance to a segment along a ray; infinite if it misses.
  Real distance(std::size_t segment, const Point& position, const Point& direction) const;
  /// Through which segments are seen.
  std::vector<Window> windows(const Point& position, const Point& normal, const std::vector<std::size_t>& behind) const;
  /// The angles between `window`'s at which the light on its segment may change its formula.
  std::vector<Real> breaks(const Window& window, const Point& position, const Point& normal) const;

  const FlatlandRoom& room_;
  std::vector<Point> corners_;  ///< ends of segments and where they cross, each once
};

}  // namespace irradiff
