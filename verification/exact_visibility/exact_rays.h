#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace irradiff {

/// Irradiance from random rays, W/m^2.
struct RayCastIrradiance {
  double mean = 0.0;
  double standard_error = 0.0;
};

/// E = pi times the mean radiance over cosine-weighted random directions, with its standard error: a crude check of
/// visibility that knows nothing of edges, arcs and horizons. Every ray is intersected exactly, with all triangles of a
/// fan over each polygon; it hits a polygon where it hits an odd number of them. (It meets an edge of the fan with
/// probability 0.) The front-most hit counts. What contains the receiver in its plane is left out, as it has no image.
///
/// The directions depend on seed and ray alone. Requires polygons and receiver as exactVisibility() does, rays >= 2;
/// throws InvalidScene for what `validate` refuses.
RayCastIrradiance castExactRays(const std::vector<Polygon>& polygons, const Receiver& receiver, std::uint64_t seed,
                                std::size_t rays);

/// The front-most polygon along a ray.
struct ExactHit {
  std::size_t polygon = 0;  ///< index in the scene
  double distance = 0.0;    ///< metres, to within a few ulps
};

/// What castExactRays() hits in the given directions (of any length, not zero), nothing where that is nothing; above
/// and below the horizon. Of polygons at the same distance the first one counts. Throws as castExactRays() does.
std::vector<std::optional<ExactHit>> exactHits(const std::vector<Polygon>& polygons, const Receiver& receiver,
                                               std::span<const Eigen::Vector3d> directions);

}  // namespace irradiff
