#pragma once

#include "experiments/cache_3d/camera_view.h"
#include "experiments/cache_3d/room.h"
#include "experiments/cache_3d/slice_quadrature.h"
#include "experiments/io/exr_file.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// The true irradiance of what a camera's pixels see, with its tangential gradients in world axes.
struct RoomReference {
  std::vector<SliceIrradiance> values;
  /// RMS of the difference from a finer quadrature at some of the pixels. W/m^2.
  double rms_error = 0.0;
};

/// Steps of a quadrature whose error is small beside that of another with `steps`.
SliceSteps finerSteps(const SliceSteps& steps);

/// RMS of the difference between the given values and those of finerSteps(), at about `count` of the points, evenly
/// spread over their numbers. W/m^2.
double referenceError(const Room& room, const SurfaceRadiance& radiance, std::span<const SeenPoint> seen,
                      std::span<const SliceIrradiance> values, std::size_t count, unsigned threads);

/// Number of points at which the error of a reference is measured.
inline constexpr std::size_t kErrorPoints = 200;

/// ROOM_WIDTH.exr in a folder.
std::filesystem::path referencePath(const std::filesystem::path& folder, const Room& room, std::size_t width);

/// A reference as an image: channels "E" and "gradient.x" to ".z", NaN where a pixel has no receiver. The attributes
/// say how it was made: "made_from" is all that the values depend on (room, table, steps), "rms_error" the error.
ExrImage referenceImage(const Room& room, std::size_t width, std::span<const SeenPoint> seen,
                        const RoomReference& reference);

/// The reference at `path`; nothing if there is no such file or if it was made from anything else. Throws
/// std::runtime_error if there is one that cannot be read.
std::optional<RoomReference> readReference(const std::filesystem::path& path, const Room& room, std::size_t width,
                                           std::span<const SeenPoint> seen);

}  // namespace irradiff
