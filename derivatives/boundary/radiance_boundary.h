#pragma once

#include "derivatives/boundary/vector.h"

#include <vector>

namespace irradiff {

/// One end of an arc as the receiver sees it.
template <class Scalar>
struct ArcEnd {
  Vector3<Scalar> direction;  ///< unit
  Scalar inverse_distance;    ///< 1/m
  Scalar cosine;              ///< normal . direction, in [0, 1]; exactly 0 where the arc was cut at the horizon
};

/// A piece of a straight scene edge across which radiance jumps, seen from the receiver and above its horizon.
///
/// The ends carry all that the integrals along the arc need: inverse distance, cosine and direction are linear in the
/// direction, so that between the ends each is a combination with the positive weights of ArcMoments. Nothing is
/// divided by |r x e|, and nothing cancels within an arc. docs/derivations/radiance_boundary.md, section 4.
template <class Scalar>
struct BoundaryArc {
  Vector3<Scalar> plane_normal;  ///< unit vector along r x e; zero for an edge whose line passes through the receiver
  Vector3<Scalar> turned_plane_normal;  ///< receiver's normal x plane_normal: small where the arc is near the horizon
  Vector3<Scalar> edge_direction;       ///< unit vector along e
  Scalar angle;                         ///< angle that the arc subtends, in [0, 2]
  Scalar angle_over_foot_distance;  ///< angle / distance from the receiver to the edge's line, finite for radial edges
                                    ///< too; 1/m
  /// Times angle_over_foot_distance: what the errors of doubled precision in angle * turned_plane_normal are
  /// proportional to (docs/derivations/error_bounds.md, section 2.9).
  Scalar cancellation_distance;
  ArcEnd<Scalar> first, last;  ///< in the direction of e
  Scalar radiance_jump;        ///< radiance on the right of the arc minus that on its left, seen along e; W/(m^2 sr)
};

/// All that irradiance, its gradient and its Hessian depend on: the arcs between regions of different radiance.
/// Filled from polygons (polygonBoundary in derivatives/boundary/edge_arcs.h); summed by
/// derivatives/boundary/boundary_sums.h.
template <class Scalar>
struct RadianceBoundary {
  std::vector<BoundaryArc<Scalar>> arcs;
  /// Sum over arcs of the horizon itself of radiance jump times signed angle about the normal times |n|: counts for
  /// irradiance only, since the cosine vanishes there. W rad/(m^2 sr).
  Scalar horizon_angle = lift<Scalar>(0.0);
  /// The same sum of absolute values: edges of the horizon that run over each other cancel only up to their rounding.
  Scalar horizon_size = lift<Scalar>(0.0);
};

}  // namespace irradiff
