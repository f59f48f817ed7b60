#pragma once

#include "experiments/cache_3d/camera_view.h"
#include "experiments/cache_3d/room.h"
#include "experiments/cache_3d/surface_radiance.h"

#include <Eigen/Core>

#include <cstddef>
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

/// Evenly spread over what the camera sees, so some near edges.
std::vector<SeenPoint> somePoints(const Room& room, std::size_t count);

Eigen::Vector3d tangential(const Eigen::Vector3d& v, const Eigen::Vector3d& normal);

}  // namespace irradiff
