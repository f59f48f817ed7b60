#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/cache_2d/flatland_room.h"
#include "experiments/cache_3d/room.h"
#include "experiments/figures/analytic_figure.h"
#include "experiments/figures/tile_store.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <variant>

namespace irradiff {

/// A file that a cache can run on: a room in 3D or in flatland, or a scene with a grid of receivers.
struct RecordScene {
  std::string name;  ///< the file, without its folder and ending
  std::string description;
  std::string text;  ///< all that is in the file
  std::variant<FlatlandRoom, Room, FigureScene> scene;

  bool isFlatland() const { return std::holds_alternative<FlatlandRoom>(scene); }
  /// Derivatives of a scene with a grid are exact unless rays are asked for.
  bool isPlane() const { return std::holds_alternative<FigureScene>(scene); }
};

/// Throws std::runtime_error naming the file and what is wrong with it: one that cannot be read, of another format, a
/// scene without a grid, or one in which nothing radiates.
RecordScene readRecordScene(const std::filesystem::path& path);

struct RecordFieldPlan {
  std::size_t width = 256;  ///< of the image; receivers of a line or along the longer side of a grid
  std::size_t rays = 4096;  ///< for each record; a grid takes 0 for exact derivatives, flatland is always exact
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< nothing depends on it
};

/// All that the numbers of a field depend on, for a TileStore.
std::string fieldFingerprint(const RecordScene& scene, const RecordFieldPlan& plan);

/// Throws std::runtime_error naming the scene if the irradiance is 0 everywhere.
RecordField recordField(const RecordScene& scene, const RecordFieldPlan& plan, const TileStore* finished,
                        const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
