#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiff {

struct RandomScene {
  std::vector<Polygon> polygons;  ///< an emitter, then occluders of less radiance that hide parts of it
  Receiver receiver;
};

/// Star-shaped polygons, as a rule not convex, in planes of any orientation; some intersect each other and most are cut
/// by the horizon. All coordinates are multiples of 2^-10, so that every polygon is exactly planar.
RandomScene randomScene(std::uint64_t seed, std::size_t index, std::size_t occluders);

/// Triangles with small integers as coordinates, a receiver and a normal with such too: edges that coincide in space or
/// in view, vertices on foreign edges and on the horizon, triangles edge-on, coplanar and overlapping, in every scene.
/// The radiance depends on the plane alone, so that what overlaps in one plane is of one radiance.
RandomScene latticeScene(std::uint64_t seed, std::size_t index, std::size_t triangles);

}  // namespace irradiff
