#pragma once

#include "experiments/figures/derivative_map.h"
#include "experiments/io/png_file.h"

#include <string>
#include <vector>

namespace irradiff {

/// What the colours of a picture mean: colours at even steps from `low` to `high`.
struct ColourBar {
  std::string label;  ///< the channel, where a picture shows several; or else empty
  double low = 0.0;
  double high = 0.0;
  std::vector<Rgb> colours;
};

/// A map in colours, a pixel for each receiver: x to the right, y upwards. No text, no bars.
struct MapPicture {
  std::string name;     ///< of its file, "gradient.x"
  std::string title;    ///< a phrase for people
  std::string unit;     ///< of its bars, in plain ASCII
  std::string scaling;  ///< a sentence: how values become colours
  RgbImage image;
  std::vector<ColourBar> bars;
};

/// The pictures of a map: E, the mappings of the paper's Figure 5 ("gradient", (dE/dx, dE/dy) -> (r, g), and
/// "eigenvalues", (lambda1, lambda2, lambda3) -> (r, g, b)), each single channel but the bounds, and the events.
///
/// Amounts run from 0 to their maximum. Signed values are symmetric about 0 up to a limit that 97 % of the magnitudes
/// do not exceed, rounded up to two digits; those beyond have the colour of the limit. In the paper's mappings a
/// component is 0.5 at 0, 0 and 1 at the limits, which are common to the components; the gradient's blue is 0.5.
std::vector<MapPicture> mapPictures(const DerivativeMap& map);

}  // namespace irradiff
