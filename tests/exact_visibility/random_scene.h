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

}  // namespace irradiff
