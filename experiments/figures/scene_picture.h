#pragma once

#include "experiments/figures/derivative_map.h"
#include "experiments/io/png_file.h"
#include "experiments/io/scene_file.h"

#include <cstddef>

namespace irradiff {

/// The scene seen from aside and above, `size` pixels square: what radiates in a light colour, what does not in a dark
/// one, and over the grid its irradiance. Polygons that hide the middle of the grid are left out, so that one looks
/// into a closed room.
RgbImage scenePicture(const Scene& scene, const DerivativeMap& map, std::size_t size);

}  // namespace irradiff
