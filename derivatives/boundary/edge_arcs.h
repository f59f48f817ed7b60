#pragma once

#include "derivatives/boundary/horizon_clip.h"
#include "derivatives/boundary/radiance_boundary.h"

namespace irradiff {

/// Arcs longer than this (radians) are cut at the foot of the perpendicular from the receiver: the endpoint weights of
/// ArcMoments grow without limit as the angle goes to pi. Any value between pi/2 and about 2.5 serves.
inline constexpr double kLongestArc = 2.0;

namespace detail {

template <class Scalar>
ArcEnd<Scalar> arcEnd(const Vector3<Scalar>& position, const Scalar& distance, const Scalar& height) {
  const Scalar inverse = lift<Scalar>(1.0) / distance;
  return {scaled(position, inverse), inverse, height * inverse};
}

/// angle / (distance to the line) from the area |r0 x r1| = |e| d of the arc's parallelogram; continuous where the area
/// is 0.
template <class Scalar>
Scalar angleOverFootDistance(const Scalar& angle, const Scalar& area, const Scalar& cosine_product,
                             const Scalar& length) {
  // atan q = q (1 - q^2/3 + ...): for machine numbers the first term is the ratio to within an ulp where q^2 is one.
  // Numbers of chosen precision need it only where the quotient is not defined.
  const Scalar smallest = lift<Scalar>(kIsMachinePrecision<Scalar> ? 0x1p-32 : 0.0);
  if (area <= cosine_product * smallest) {
    return length / cosine_product;
  }
  return angle * length / area;
}

}  // namespace detail

/// Appends the arc of the straight edge from `start` to `end` (both above or on the horizon, not both on it), or its
/// two parts if it is longer than kLongestArc. r x e is taken at the nearer end in the wider scalar, where the
/// difference of the products cancels least, and so is n x (r x e), which cancels where the arc is near the horizon.
/// Requires that the receiver is not on the edge.
template <class Scalar, class WideScalar>
void appendEdgeArcs(const ClippedVertex<Scalar, WideScalar>& start, const ClippedVertex<Scalar, WideScalar>& end,
                    const Vector3<Scalar>& normal, const Scalar& radiance_jump,
                    std::vector<BoundaryArc<Scalar>>& arcs) {
  using std::atan2;
  const Vector3<Scalar> r0 = narrow<Scalar>(start.position);
  const Vector3<Scalar> r1 = narrow<Scalar>(end.position);
  const Scalar distance0 = norm(r0);
  const Scalar distance1 = norm(r1);
  const Vector3<WideScalar> wide_edge = difference(end.position, start.position);
  const Vector3<Scalar> edge = narrow<Scalar>(wide_edge);
  const Scalar length = norm(edge);
  const Vector3<WideScalar> wide_moment = cross(distance0 <= distance1 ? start.position : end.position, wide_edge);
  const Vector3<Scalar> moment = narrow<Scalar>(wide_moment);
  const Scalar area = norm(moment);
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar one = lift<Scalar>(1.0);
  const Scalar cosine_product = dot(r0, r1);

  BoundaryArc<Scalar> arc;
  const bool has_angle = isPositive(area);
  const Scalar inverse_area = has_angle ? Scalar(one / area) : zero;
  arc.plane_normal = scaled(moment, inverse_area);
  arc.turned_plane_normal = scaled(narrow<Scalar>(cross(widen<WideScalar>(normal), wide_moment)), inverse_area);
  arc.edge_direction = scaled(edge, Scalar(one / length));
  arc.angle = has_angle ? Scalar(atan2(area, cosine_product)) : zero;
  arc.radiance_jump = radiance_jump;
  // The product r x e loses |r||e|/|r x e|, and a cut's direction tilts the plane by 1/sin(angle).
  const Scalar from_cuts = (start.height > zero ? zero : distance1) + (end.height > zero ? zero : distance0);
  arc.cancellation_distance = (distance0 <= distance1 ? distance0 : distance1) + from_cuts / length;
  arc.first = detail::arcEnd(r0, distance0, start.height);
  arc.last = detail::arcEnd(r1, distance1, end.height);
  if (!(arc.angle > lift<Scalar>(kLongestArc))) {
    arc.angle_over_foot_distance = detail::angleOverFootDistance(arc.angle, area, cosine_product, length);
    arcs.push_back(arc);
    return;
  }
  const Scalar foot_distance = area / length;
  const Scalar before_foot = -dot(r0, arc.edge_direction);
  const Scalar after_foot = dot(r1, arc.edge_direction);
  const Scalar foot_height = (after_foot * start.height + before_foot * end.height) / length;
  const ArcEnd<Scalar> foot{cross(arc.edge_direction, arc.plane_normal), one / foot_distance,
                            foot_height / foot_distance};
  BoundaryArc<Scalar> rest = arc;
  arc.last = foot;
  arc.angle = atan2(before_foot, foot_distance);
  arc.angle_over_foot_distance = arc.angle / foot_distance;
  rest.first = foot;
  rest.angle = atan2(after_foot, foot_distance);
  rest.angle_over_foot_distance = rest.angle / foot_distance;
  arcs.push_back(arc);
  arcs.push_back(rest);
}

/// The radiance boundary of one clipped polygon with radiance 1 on a background of 0, its vertices running clockwise
/// seen from the receiver. Edges of the horizon enter `horizon_angle` only.
template <class Scalar, class WideScalar>
RadianceBoundary<Scalar> polygonBoundary(const ClippedPolygon<Scalar, WideScalar>& polygon,
                                         const Vector3<Scalar>& normal) {
  using std::atan2;
  const Scalar zero = lift<Scalar>(0.0);
  RadianceBoundary<Scalar> boundary;
  boundary.arcs.reserve(polygon.vertices.size());
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const ClippedVertex<Scalar, WideScalar>& start = polygon.vertices[i];
    const ClippedVertex<Scalar, WideScalar>& end = polygon.vertices[(i + 1) % polygon.vertices.size()];
    if (start.height > zero || end.height > zero) {
      appendEdgeArcs(start, end, normal, lift<Scalar>(1.0), boundary.arcs);
    } else {
      // The normal enters irradiance linearly and is used as given, so the angle counts |n| times.
      const Vector3<Scalar> moment = narrow<Scalar>(cross(start.position, end.position));
      const Scalar cosine_product = dot(narrow<Scalar>(start.position), narrow<Scalar>(end.position));
      const Scalar angle = norm(normal) * Scalar(atan2(norm(moment), cosine_product));
      boundary.horizon_angle = boundary.horizon_angle + withSignOf(angle, Scalar(dot(normal, moment)));
      boundary.horizon_size = boundary.horizon_size + angle;
    }
  }
  return boundary;
}

}  // namespace irradiff
