#pragma once

#include "experiments/cache_3d/room.h"
#include "experiments/cache_3d/surface_radiance.h"

#include <string>
#include <vector>

namespace irradiff {

/// A room of data/rooms.
Room dataRoom(const std::string& name);

/// The table of direct light of cornell_box, made once for all tests of a program.
const SurfaceRadiance& lightOfCornellBox();

/// A room whose light is quickly known: a floor, a wall beside it and a lamp over both, seen from the front.
Room cornerRoom();

/// The six faces of the cube [0, 2]^3 and, in it, a box that stands on the floor; all radiate `radiance`.
std::vector<Polygon> furnace(double radiance);

}  // namespace irradiff
