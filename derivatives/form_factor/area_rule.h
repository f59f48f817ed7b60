#pragma once

#include "derivatives/boundary/horizon_clip.h"
#include "derivatives/boundary/small_source.h"

#include <optional>
#include <span>

namespace irradiff {

/// Irradiance of a polygon of radiance 1 and its derivatives, with the sizes that rounding errors are proportional to.
struct AreaRuleSums {
  SmallSourceSums<3> sums;
  double terms;       ///< number of them in the sums
  double truncation;  ///< bound of the quadrature error, relative to the sizes
};

/// Whether every vertex is within kSmallSourceExtent of the first one, in units of that one's distance from the
/// receiver.
bool isSmallSource(const ClippedPolygon<double>& polygon);

/// Whether the fan of triangles at the first vertex runs over itself: two of them turn opposite ways. Its terms cancel
/// then, and the more the more often the polygon winds about that vertex. (Decided in double: triangles that rounding
/// turns are too small to matter.)
bool fanOverlaps(const ClippedPolygon<double>& polygon);

// The area rule: the defining integral over a polygon that is small compared with its distance, and its kernel's
// derivatives under the integral sign,
//   E = int (n.p)(N.p)/|p|^4 dA,
// by tensor Gauss-Legendre quadrature on triangles. They are those of the fan if `triangles` is empty, and else
// `triangles`, which cover the polygon without overlaps and are cut at the horizon like it. A sum over edges loses
// distance/size to cancellation; here nothing cancels. Where the polygon is cut at the horizon, the cut moves with the
// receiver, and the Hessian has in addition minus the term that the cut would add if it were a fixed edge
// (docs/derivations/radiance_boundary.md, section 6). Returns nothing unless the polygon, or each of `triangles`, is a
// small source. Vertices clockwise seen from the receiver for E > 0.
std::optional<AreaRuleSums> areaRule(const ClippedPolygon<double>& polygon,
                                     std::span<const ClippedPolygon<double>> triangles, const Vector3<double>& normal);

}  // namespace irradiff
