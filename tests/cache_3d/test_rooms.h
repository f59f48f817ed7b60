#pragma once

#include "experiments/cache_3d/room.h"

#include <string>
#include <vector>

namespace irradiff {

/// A room of data/rooms.
Room dataRoom(const std::string& name);

/// A room whose light is quickly known: a floor, a wall beside it and a lamp over both, seen from the front.
Room cornerRoom();

/// The six faces of the cube [0, 2]^3 and, in it, a box that stands on the floor; all radiate `radiance`.
std::vector<Polygon> furnace(double radiance);

}  // namespace irradiff
