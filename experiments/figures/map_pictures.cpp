#include "experiments/figures/map_pictures.h"

#include "experiments/figures/colour_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace irradiff {
namespace {

constexpr Rgb kNoEventColour{255, 255, 255};
constexpr Rgb kEventColour{38, 38, 38};

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
  pictures.insert(pictures.begin() + 1, triplePicture(map.grid, "gradient", "(dE/dx, dE/dy) as (red, green)", gradient,
                                                      limitOf(gradient, kShareWithinLimit)));
  pictures.insert(pictures.begin() + 2,
                  triplePicture(map.grid, "eigenvalues", "eigenvalues of the Hessian in space as (red, green, blue)",
                                eigenvalues, limitOf(eigenvalues, kShareWithinLimit)));
  return pictures;
}

}  // namespace irradiff
