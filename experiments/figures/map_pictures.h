#pragma once

#include "experiments/figures/channel_pictures.h"
#include "experiments/figures/derivative_map.h"

#include <vector>

namespace irradiff {

/// The pictures of a map: E, the mappings of the paper's Figure 5 ("gradient", (dE/dx, dE/dy) -> (r, g), and
/// "eigenvalues", (lambda1, lambda2, lambda3) -> (r, g, b)), each single channel but the bounds, and the events.
///
/// Amounts run from 0 to their maximum. Signed values are symmetric about 0 up to a limit that 97 % of the magnitudes
/// do not exceed, rounded up to two digits; those beyond have the colour of the limit. In the paper's mappings a
/// component is 0.5 at 0, 0 and 1 at the limits, which are common to the components; the gradient's blue is 0.5.
std::vector<MapPicture> mapPictures(const DerivativeMap& map);

}  // namespace irradiff
