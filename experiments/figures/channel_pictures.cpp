#include "experiments/figures/channel_pictures.h"

#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace irradiff {
namespace {

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

double shareBeyond(const std::vector<double>& sorted, double limit) {
  const auto beyond = sorted.end() - std::ranges::upper_bound(sorted, limit);
  return static_cast<double>(beyond) / static_cast<double>(sorted.size());
}

}  // namespace

ScaleLimit limitOf(std::span<const MapChannel* const> channels, double share_within) {
  const std::vector<double> magnitudes = sortedMagnitudes(channels);
  if (magnitudes.empty() || magnitudes.back() == 0.0) {
    return {};
  }
  const auto count = static_cast<double>(magnitudes.size());
  const auto place = static_cast<std::size_t>(std::ceil(share_within * count)) - 1;
  const double limit = roundedUp(magnitudes[place] > 0.0 ? magnitudes[place] : magnitudes.back());
  return {limit, shareBeyond(magnitudes, limit)};
}

ScaleLimit limitAt(std::span<const MapChannel* const> channels, double limit) {
  const std::vector<double> magnitudes = sortedMagnitudes(channels);
  return {limit, magnitudes.empty() ? 0.0 : shareBeyond(magnitudes, limit)};
}

std::string beyondText(const ScaleLimit& limit) {
  if (limit.share_beyond == 0.0) {
    return " Nothing is beyond.";
  }
  const double percent = std::max(0.01, std::round(1e4 * limit.share_beyond) / 100.0);
  return ' ' + numberText(percent) + " % of the values are beyond and have the colour of the limit.";
}

MapPicture triplePicture(const ReceiverGrid& grid, const std::string& name, const std::string& title,
                         std::span<const MapChannel* const> channels, const ScaleLimit& limit) {
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

}  // namespace irradiff
