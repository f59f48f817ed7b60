#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/cache_3d/room.h"
#include "experiments/figures/tile_store.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

namespace irradiff {

struct RoomFieldPlan {
  std::size_t width = 256;  ///< of the image; as high as wide
  std::size_t rays = 4096;  ///< for each record: concentric strata, so a square number, at least 4
  std::uint64_t seed = 1;
  unsigned threads = 1;              ///< nothing depends on it
  std::filesystem::path references;  ///< folder with reference images; without one that fits it is computed
};

/// Error profiles of a room's receivers.
inline constexpr std::size_t kRoomProfileDirections = 16;
inline constexpr std::size_t kRoomPredictedDistances = 16;  ///< of `reprojection`
inline constexpr std::size_t kRoomTrueDistances = 24;       ///< of `oracle`

/// Every pixel's gather of the one-bounce indirect irradiance of a room: the record that the pixel would make, for all
/// metrics. The truth is by slices (SliceQuadrature); both read the same table of direct light.
///
/// The oracle's error at x + d is that of the record's own extrapolation, with the irradiance and the gradient that it
/// gathered, as in Eq. (4) of [Schwarzhaupt et al. 2012]: near an edge a noisy gradient limits what a record is good
/// for more than any curvature. At x + d the truth is that of the image (ImageIrradiance); the error is 0 where the
/// camera does not see that point.
///
/// Tiles of finished rows are taken from `finished` if it is not null: 2 for each row of the image. `progress(done,
/// all)` counts rows; those whose reference is computed count twice. Throws std::invalid_argument naming the width
/// unless it is at least 1, and as gatherShape().
RecordField roomField(const Room& room, const RoomFieldPlan& plan, const TileStore* finished,
                      const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
