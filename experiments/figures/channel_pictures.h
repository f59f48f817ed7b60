#pragma once

#include "experiments/figures/derivative_map.h"
#include "experiments/io/png_file.h"
#include "experiments/io/receiver_grid.h"

#include <cstddef>
#include <span>
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

/// Where a scale ends, and how many of the values are beyond.
struct ScaleLimit {
  double value = 1.0;
  double share_beyond = 0.0;
};

/// Of signed values this share, at least, is within the limits.
inline constexpr double kShareWithinLimit = 0.97;

/// The limit that a share of the magnitudes does not exceed, rounded up to two digits. For channels of zeros or of
/// nothing at all, 1.
ScaleLimit limitOf(std::span<const MapChannel* const> channels, double share_within);

/// A limit that was found elsewhere, with the share of these channels' values that are beyond.
ScaleLimit limitAt(std::span<const MapChannel* const> channels, double limit);

/// A sentence on what is beyond, with a space before it.
std::string beyondText(const ScaleLimit& limit);

inline constexpr std::size_t kBarSteps = 65;

template <class ColourAt>
RgbImage imageOf(const ReceiverGrid& grid, ColourAt colour_at) {
  RgbImage image(grid.width, grid.height, {});
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i) {
      // Images begin at the top.
      image.at(i, grid.height - 1 - j) = colour_at(j * grid.width + i);
    }
  }
  return image;
}

template <class ColourAt>
ColourBar barOf(const std::string& label, double low, double high, ColourAt colour_at) {
  ColourBar bar{label, low, high, {}};
  for (std::size_t i = 0; i < kBarSteps; ++i) {
    bar.colours.push_back(colour_at(low + (high - low) * static_cast<double>(i) / (kBarSteps - 1)));
  }
  return bar;
}

/// Up to three channels as red, green and blue; a component without a channel is 0.5. A component is 0.5 at 0, and 0
/// and 1 at the limits, which all components share.
MapPicture triplePicture(const ReceiverGrid& grid, const std::string& name, const std::string& title,
                         std::span<const MapChannel* const> channels, const ScaleLimit& limit);

}  // namespace irradiff
