#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <span>

namespace irradiff {

/// Irradiance of one convex emitter in a plane z = constant behind convex black occluders that are all between the
/// receiver's z and the emitter's: each occluder is projected from the receiver onto the emitter's plane, and what they
/// cover is taken off by inclusion and exclusion over their intersections. Shares with the library's visibility nothing
/// but the irradiance of a single polygon. The emitter is the first polygon.
double irradianceByClipping(std::span<const Polygon> polygons, const Receiver& receiver);

}  // namespace irradiff
