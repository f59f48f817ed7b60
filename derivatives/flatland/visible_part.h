#pragma once

#include "derivatives/flatland/segment_form.h"
#include "derivatives/flatland/segment_visibility.h"

#include <array>
#include <span>
#include <type_traits>

namespace irradiff {

template <class Scalar>
using SegmentEnds = std::array<Vector2<Scalar>, 2>;

/// A point relative to the receiver, and its height n.r above the horizon.
template <class Scalar>
struct SeenPoint {
  Vector2<Wide<Scalar>> position;
  Scalar height;
};

/// Where the lines of a and b cross, relative to the receiver, each number to 18 u^2 (the height to u) however flat the
/// angle and however close the horizon: computed without error and rounded once. Requires lines that cross.
SeenPoint<double> exactCrossing(const SegmentEnds<double>& a, const SegmentEnds<double>& b,
                                const Vector2<double>& position, const Vector2<double>& normal);

template <class Scalar>
SeenPoint<Scalar> crossingOf(const SegmentEnds<Scalar>& a, const SegmentEnds<Scalar>& b,
                             const Vector2<Scalar>& position, const Vector2<Scalar>& normal) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return exactCrossing(a, b, position, normal);
  } else {
    using WideScalar = Wide<Scalar>;
    const Vector2<WideScalar> edge_a = wideDifference<WideScalar>(a[1], a[0]);
    const Vector2<WideScalar> edge_b = wideDifference<WideScalar>(b[1], b[0]);
    const WideScalar along =
        cross(Vector2<WideScalar>(wideDifference<WideScalar>(b[0], a[0])), edge_b) / cross(edge_a, edge_b);
    const Vector2<WideScalar> start = wideDifference<WideScalar>(a[0], position);
    const Vector2<WideScalar> r{start(0) + along * edge_a(0), start(1) + along * edge_a(1)};
    return {r, static_cast<Scalar>(dot(widen<WideScalar>(normal), r))};
  }
}

/// The visible part as if it were a segment between its boundary points: in flatland that has the same irradiance,
/// gradient and Hessian, since they depend on these two points alone (docs/derivations/flatland.md, section 5). Where
/// the horizon cuts, the point on the horizon is as far as the other one. `segments` are those visibleParts() was asked
/// about; that one may ask at another Scalar is what freezes the topology for derivatives of any kind.
template <class Scalar>
ClippedSegment<Scalar> clipPart(const VisiblePart& part, std::span<const SegmentEnds<Scalar>> segments,
                                const Vector2<Scalar>& position, const Vector2<Scalar>& normal) {
  using Kind = BoundaryPoint::Kind;
  using WideScalar = Wide<Scalar>;
  const auto seen = [&](const BoundaryPoint& point) {
    if (point.kind == Kind::kCrossing) {
      return crossingOf<Scalar>(segments[point.segment], segments[point.other], position, normal);
    }
    const Vector2<Scalar>& end = segments[point.segment][point.end];
    return SeenPoint<Scalar>{wideDifference<WideScalar>(end, position),
                             static_cast<Scalar>(horizonHeight<WideScalar>(end, position, normal))};
  };
  // The horizon runs along -J n on the clockwise side and J n on the other.
  const auto onHorizon = [&](const SeenPoint<Scalar>& other, double turn) {
    const WideScalar distance(Scalar(norm(narrow<Scalar>(other.position)) * lift<Scalar>(turn)));
    const Vector2<Scalar> tangent = quarterTurn(normal);
    return SeenPoint<Scalar>{{WideScalar(tangent(0)) * distance, WideScalar(tangent(1)) * distance}, lift<Scalar>(0.0)};
  };
  const bool is_first_cut = part.first.kind == Kind::kHorizon;
  const bool is_last_cut = part.last.kind == Kind::kHorizon;
  const SeenPoint<Scalar> first = is_first_cut ? onHorizon(seen(part.last), -1.0) : seen(part.first);
  const SeenPoint<Scalar> last = is_last_cut ? onHorizon(first, 1.0) : seen(part.last);
  return {first.position, last.position, first.height, last.height, is_first_cut || is_last_cut, true};
}

}  // namespace irradiff
