#pragma once

#include "experiments/figures/map_pictures.h"
#include "experiments/io/png_file.h"

namespace irradiff {

/// A picture with its name and unit above and its colour bars, labelled, to the right; on white. A small map is
/// enlarged by a whole factor, so that its longer side has at least 256 pixels.
RgbImage preview(const MapPicture& picture);

}  // namespace irradiff
