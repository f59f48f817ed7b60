#pragma once

#include "derivatives/boundary/horizon_height.h"
#include "derivatives/boundary/vector.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace irradiff {

/// A vertex relative to the receiver, in the wider scalar, and its height n.r above the receiver's horizon (0 where an
/// edge was cut there). Lengths in metres.
template <class Scalar, class WideScalar = Wide<Scalar>>
struct ClippedVertex {
  Vector3<WideScalar> position;
  Scalar height;
};

/// A closed loop of vertices in the half space n.r >= 0. Consecutive vertices that both have height 0 are joined by an
/// edge of the horizon.
template <class Scalar, class WideScalar = Wide<Scalar>>
struct ClippedPolygon {
  std::vector<ClippedVertex<Scalar, WideScalar>> vertices;
  bool crosses_horizon = false;  ///< whether anything was cut away
};

/// The part of a closed loop above the horizon, from the heights of its vertices in the wider scalar (Sutherland and
/// Hodgman 1974). A non-convex loop may come back with edges of the horizon that run over each other in opposite
/// directions; they cancel. The loop is empty if nothing rises above the horizon. Requires heights of certain sign.
template <class Scalar, class WideScalar>
ClippedPolygon<Scalar, WideScalar> clipAtHorizon(std::vector<ClippedVertex<Scalar, WideScalar>> loop,
                                                 std::span<const WideScalar> heights) {
  const Scalar zero = lift<Scalar>(0.0);
  bool any_above = false;
  bool any_below = false;
  for (const ClippedVertex<Scalar, WideScalar>& vertex : loop) {
    any_above = any_above || vertex.height > zero;
    any_below = any_below || vertex.height < zero;
  }
  if (!any_above) {
    return {{}, any_below};
  }
  if (!any_below) {
    return {std::move(loop), false};
  }
  ClippedPolygon<Scalar, WideScalar> clipped{{}, true};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t next = (i + 1) % loop.size();
    const ClippedVertex<Scalar, WideScalar>& a = loop[i];
    const ClippedVertex<Scalar, WideScalar>& b = loop[next];
    if (!(a.height < zero)) {
      clipped.vertices.push_back(a);
    }
    if ((a.height < zero && b.height > zero) || (a.height > zero && b.height < zero)) {
      // From the end that is seen: what rounds is relative to its distance, not to that of what is cut away.
      const std::size_t seen = a.height > zero ? i : next;
      const std::size_t hidden = a.height > zero ? next : i;
      const WideScalar fraction = heights[seen] / (heights[seen] - heights[hidden]);
      Vector3<WideScalar> crossing;
      for (int k = 0; k < 3; ++k) {
        const WideScalar along = loop[hidden].position(k) - loop[seen].position(k);
        crossing(k) = loop[seen].position(k) + fraction * along;
      }
      clipped.vertices.push_back({crossing, zero});
    }
  }
  return clipped;
}

/// The part of a closed loop of vertices above the horizon of the receiver at `position` with unit `normal`.
template <class Scalar, class WideScalar = Wide<Scalar>>
ClippedPolygon<Scalar, WideScalar> clipAtHorizon(std::span<const Vector3<Scalar>> vertices,
                                                 const Vector3<Scalar>& position, const Vector3<Scalar>& normal) {
  std::vector<ClippedVertex<Scalar, WideScalar>> loop;
  std::vector<WideScalar> heights;
  loop.reserve(vertices.size());
  heights.reserve(vertices.size());
  for (const Vector3<Scalar>& vertex : vertices) {
    heights.push_back(horizonHeight<WideScalar>(vertex, position, normal));
    loop.push_back({wideDifference<WideScalar>(vertex, position), static_cast<Scalar>(heights.back())});
  }
  return clipAtHorizon<Scalar, WideScalar>(std::move(loop), std::span<const WideScalar>(heights));
}

}  // namespace irradiff
