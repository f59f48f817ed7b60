#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/cache_3d/room.h"
#include "experiments/figures/tile_store.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace irradiff {

struct RoomFieldPlan {
  std::size_t width = 256;  ///< of the image; as high as wide
  std::size_t rays = 4096;  ///< for each record: concentric strata
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< nothing depends on it
};

/// Every pixel's gather of the one-bounce indirect irradiance of a room: the record that the pixel would make, for all
/// metrics. Tiles of finished rows are taken from `finished` if it is not null. `progress(done, all)` counts rows.
RecordField roomField(const Room& room, const RoomFieldPlan& plan, const TileStore* finished,
                      const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
