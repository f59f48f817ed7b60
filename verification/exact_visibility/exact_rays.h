#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <cstddef>
#include <cstdint>
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

}  // namespace irradiff
