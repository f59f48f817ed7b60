#include "experiments/figures/colour_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace irradiff {
namespace {

/// Odd, so that 0 of a signed value has an entry of its own.
constexpr std::size_t kEntries = 511;
using ColourTable = std::array<Rgb, kEntries>;

struct LinearRgb {
  double red;
  double green;
  double blue;

  bool isInGamut() const { return std::min({red, green, blue}) >= 0.0 && std::max({red, green, blue}) <= 1.0; }
};

/// Ottosson's matrices; `hue` in degrees.
LinearRgb linearRgb(double lightness, double chroma, double hue) {
  const double angle = hue * std::numbers::pi / 180.0;
  const double a = chroma * std::cos(angle);
  const double b = chroma * std::sin(angle);
  const auto cube = [](double value) { return value * value * value; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// IEC 61966-2-1.
std::uint8_t encoded(double linear) {
  const double value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// The colour of this lightness and hue with as much of the chroma as sRGB has.
Rgb colourOf(double lightness, double chroma, double hue) {
  double inside = 0.0;
  double outside = chroma;
  if (linearRgb(lightness, chroma, hue).isInGamut()) {
    inside = chroma;
  } else {
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (inside + outside);
      (linearRgb(lightness, middle, hue).isInGamut() ? inside : outside) = middle;
    }
  }
  const LinearRgb linear = linearRgb(lightness, inside, hue);
  return {encoded(linear.red), encoded(linear.green), encoded(linear.blue)};
}

ColourTable sequentialTable() {
  ColourTable table{};
  for (std::size_t i = 0; i < kEntries; ++i) {
    const double t = static_cast<double>(i) / (kEntries - 1);
    table[i] = colourOf(0.14 + 0.83 * t, 0.17, 295.0 + 170.0 * t);
  }
  return table;
}

ColourTable divergingTable() {
  ColourTable table{};
  for (std::size_t i = 0; i < kEntries; ++i) {
    const double t = 2.0 * static_cast<double>(i) / (kEntries - 1) - 1.0;
    table[i] = colourOf(0.97 - 0.57 * std::abs(t), 0.24 * std::abs(t), t < 0.0 ? 255.0 : 27.0);
  }
  return table;
}

/// `t` from 0 to 1.
Rgb entry(const ColourTable& table, double t) {
  return table[static_cast<std::size_t>(std::lround(std::clamp(t, 0.0, 1.0) * (kEntries - 1)))];
}

}  // namespace

Rgb sequentialColour(double t) {
  static const ColourTable kTable = sequentialTable();
  return std::isnan(t) ? kNoValueColour : entry(kTable, t);
}

Rgb divergingColour(double t) {
  static const ColourTable kTable = divergingTable();
  return std::isnan(t) ? kNoValueColour : entry(kTable, 0.5 * (t + 1.0));
}

}  // namespace irradiff
