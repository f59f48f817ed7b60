#include "experiments/figures/map_pictures.h"

#include "derivatives/scene/number_text.h"
#include "experiments/figures/colour_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace irradiff {
namespace {

constexpr double kShareWithinLimit = 0.97;
constexpr std::size_t kBarSteps = 65;
constexpr Rgb kNoEventColour{255, 255, 255};
constexpr Rgb kEventColour{38, 38, 38};
/// Where one of several channels has no value: the zero of the mapping is grey, and no picture has all three at their
/// lower limit.
constexpr Rgb kNoTripleColour{0, 0, 0};

/// The least number of two decimal digits that is not below a positive value.
double roundedUp(double value) {
  int exponent = static_cast<int>(std::floor(std::log10(value))) - 1;
  auto digits = static_cast<long>(std::ceil(value / std::pow(10.0, exponent)));
  // Power and quotient are rounded: one step more or less.
  const auto number = [&] { return std::stod(std::to_string(digits) + 'e' + std::to_string(exponent)); };
  while (number() < value) {
    ++digits;
  }
  return number();
}

/// Magnitudes of all values that exist, in ascending order.
std::vector<double> sortedMagnitudes(std::span<const MapChannel* const> channels) {
  std::vector<double> magnitudes;
  for (const MapChannel* channel : channels) {
    for (const double value : channel->values) {
      if (!std::isnan(value)) {
        magnitudes.push_back(std::abs(value));
      }
    }
  }
  std::ranges::sort(magnitudes);
  return magnitudes;
}

/// Where a scale ends, and how many of the values are beyond.
struct ScaleLimit {
  double value = 1.0;
  double share_beyond = 0.0;
};

/// For a map of zeros or of nothing at all, 1.
ScaleLimit limitOf(std::span<const MapChannel* const> channels, double share_within) {
  const std::vector<double> magnitudes = sortedMagnitudes(channels);
  if (magnitudes.empty() || magnitudes.back() == 0.0) {
    return {};
  }
  const auto count = static_cast<double>(magnitudes.size());
  const auto place = static_cast<std::size_t>(std::ceil(share_within * count)) - 1;
  const double limit = roundedUp(magnitudes[place] > 0.0 ? magnitudes[place] : magnitudes.back());
  const auto beyond = magnitudes.end() - std::ranges::upper_bound(magnitudes, limit);
  return {limit, static_cast<double>(beyond) / count};
}

std::string beyondText(const ScaleLimit& limit) {
  if (limit.share_beyond == 0.0) {
    return " Nothing is beyond.";
  }
  const double percent = std::max(0.01, std::round(1e4 * limit.share_beyond) / 100.0);
  return ' ' + numberText(percent) + " % of the values are beyond and have the colour of the limit.";
}

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

MapPicture amountPicture(const ReceiverGrid& grid, const MapChannel& channel) {
  const std::array<const MapChannel*, 1> channels{&channel};
  const double limit = limitOf(channels, 1.0).value;
  const auto colour = [limit](double value) { return sequentialColour(value / limit); };
  return {channel.name,
          channel.meaning,
          channel.unit,
          "Linear from 0 to the maximum, rounded up.",
          imageOf(grid, [&](std::size_t i) { return colour(channel.values[i]); }),
          {barOf("", 0.0, limit, colour)}};
}

MapPicture signedPicture(const ReceiverGrid& grid, const MapChannel& channel) {
  const std::array<const MapChannel*, 1> channels{&channel};
  const ScaleLimit limit = limitOf(channels, kShareWithinLimit);
  const auto colour = [&limit](double value) { return divergingColour(value / limit.value); };
  return {channel.name,
          channel.meaning,
          channel.unit,
          "Linear, 0 is white." + beyondText(limit),
          imageOf(grid, [&](std::size_t i) { return colour(channel.values[i]); }),
          {barOf("", -limit.value, limit.value, colour)}};
}

MapPicture flagPicture(const ReceiverGrid& grid, const MapChannel& channel) {
  return {channel.name,
          channel.meaning,
          channel.unit,
          "Dark where an event passes.",
          imageOf(grid, [&](std::size_t i) { return channel.values[i] > 0.0 ? kEventColour : kNoEventColour; }),
          {{"", 0.0, 1.0, {kNoEventColour, kEventColour}}}};
}

/// Up to three channels as red, green and blue; a component without a channel is 0.5.
MapPicture triplePicture(const ReceiverGrid& grid, const std::string& name, const std::string& title,
                         std::span<const MapChannel* const> channels) {
  const ScaleLimit limit = limitOf(channels, kShareWithinLimit);
  const auto component = [&limit](double value) {
    const double share = std::clamp(0.5 + 0.5 * value / limit.value, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * share));
  };
  const auto colour = [&](const std::array<double, 3>& values) {
    return std::ranges::any_of(values, [](double value) { return std::isnan(value); })
               ? kNoTripleColour
               : Rgb{component(values[0]), component(values[1]), component(values[2])};
  };
  MapPicture picture{name, title, channels[0]->unit, "", {}, {}};
  picture.scaling = "Linear: a component is 0.5 at 0, and 0 and 1 at the limits, which all components share" +
                    std::string(channels.size() < 3 ? "; blue is 0.5." : ".") + beyondText(limit);
  picture.image = imageOf(grid, [&](std::size_t i) {
    std::array<double, 3> values{};
    for (std::size_t c = 0; c < channels.size(); ++c) {
      values[c] = channels[c]->values[i];
    }
    return colour(values);
  });
  const std::array<const char*, 3> components{"red: ", "green: ", "blue: "};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    picture.bars.push_back(barOf(components[c] + channels[c]->name, -limit.value, limit.value, [&](double value) {
      std::array<double, 3> values{};
      values[c] = value;
      return colour(values);
    }));
  }
  return picture;
}

}  // namespace

std::vector<MapPicture> mapPictures(const DerivativeMap& map) {
  const std::array<const MapChannel*, 2> gradient{&map.channel("gradient.x"), &map.channel("gradient.y")};
  const std::array<const MapChannel*, 3> eigenvalues{&map.channel("lambda1"), &map.channel("lambda2"),
                                                     &map.channel("lambda3")};
  std::vector<MapPicture> pictures;
  for (const MapChannel& channel : map.channels) {
    switch (channel.kind) {
      case ChannelKind::kAmount:
        pictures.push_back(amountPicture(map.grid, channel));
        break;
      case ChannelKind::kSigned:
        pictures.push_back(signedPicture(map.grid, channel));
        break;
      case ChannelKind::kFlag:
        pictures.push_back(flagPicture(map.grid, channel));
        break;
      case ChannelKind::kBound:
        break;
    }
  }
  // Behind E, in the paper's order.
  pictures.insert(pictures.begin() + 1,
                  triplePicture(map.grid, "gradient", "(dE/dx, dE/dy) as (red, green)", gradient));
  pictures.insert(
      pictures.begin() + 2,
      triplePicture(map.grid, "eigenvalues", "eigenvalues of the Hessian in space as (red, green, blue)", eigenvalues));
  return pictures;
}

}  // namespace irradiff
