// Lightness is judged by CIE L*, which is not what the maps are made of.

#include "experiments/figures/colour_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace irradiff {
namespace {

constexpr int kSteps = 20;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// IEC 61966-2-1 and CIE 15: luminance of the linear components, then the cube root.
double lightness(const Rgb& colour) {
  const auto linear = [](std::uint8_t code) {
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : 24389.0 / 27.0 * y;
}

/// Steps of lightness from one of kSteps colours to the next, the map running from `begin` to `end`.
struct LightnessSteps {
  double smallest = 1e9;
  double largest = -1e9;
  double mean = 0.0;

  /// L* and OKLab's lightness are not proportional: even means within a factor of 2 of the mean.
  bool areEven() const { return smallest > 0.5 * mean && largest < 2.0 * mean; }
};

template <class Map>
LightnessSteps lightnessSteps(Map colour, double begin, double end) {
  LightnessSteps steps;
  for (int i = 0; i < kSteps; ++i) {
    const auto at = [&](int k) { return lightness(colour(begin + (end - begin) * k / kSteps)); };
    const double step = at(i + 1) - at(i);
    steps.smallest = std::min(steps.smallest, step);
    steps.largest = std::max(steps.largest, step);
    steps.mean += step / kSteps;
  }
  return steps;
}

/// The rainbow that is not ordered: the bad twin.
Rgb rainbow(double t) {
  const auto component = [t](double centre) {
    return static_cast<std::uint8_t>(255 * std::clamp(1.5 - 4 * std::abs(t - centre), 0.0, 1.0));
  };
  return {component(0.75), component(0.5), component(0.25)};
}

TEST(ColourMaps, SequentialGrowsEvenlyLighter) {
  EXPECT_TRUE(lightnessSteps(sequentialColour, 0.0, 1.0).areEven());
  EXPECT_LT(lightness(sequentialColour(0.0)), 10.0);
  EXPECT_GT(lightness(sequentialColour(1.0)), 90.0);
  EXPECT_FALSE(lightnessSteps(rainbow, 0.0, 1.0).areEven());
  EXPECT_LT(lightnessSteps(rainbow, 0.0, 1.0).smallest, 0.0);
}

TEST(ColourMaps, DivergingDarkensEvenlyToBothSides) {
  for (const double end : {-1.0, 1.0}) {
    EXPECT_TRUE(lightnessSteps(divergingColour, end, 0.0).areEven()) << end;
  }
  for (int i = 1; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const Rgb positive = divergingColour(t);
    const Rgb negative = divergingColour(-t);
    EXPECT_GT(positive.red, positive.blue);
    EXPECT_LT(negative.red, negative.blue);
    // OKLab and CIELAB differ in what they call as light as blue, by less than a step of 1/8 of the map.
    EXPECT_NEAR(lightness(positive), lightness(negative), 8.0) << t;
  }
}

TEST(ColourMaps, ZeroIsNeutral) {
  const Rgb zero = divergingColour(0.0);
  EXPECT_LE(std::max({zero.red, zero.green, zero.blue}) - std::min({zero.red, zero.green, zero.blue}), 2);
  EXPECT_GT(lightness(zero), 90.0);
}

TEST(ColourMaps, KeepToTheirEnds) {
  EXPECT_EQ(sequentialColour(-3.0), sequentialColour(0.0));
  EXPECT_EQ(sequentialColour(1e300), sequentialColour(1.0));
  EXPECT_EQ(divergingColour(-std::numeric_limits<double>::infinity()), divergingColour(-1.0));
  EXPECT_EQ(divergingColour(2.0), divergingColour(1.0));
}

TEST(ColourMaps, NoValueLooksLikeNone) {
  EXPECT_EQ(sequentialColour(kNan), kNoValueColour);
  EXPECT_EQ(divergingColour(kNan), kNoValueColour);
  for (int i = 0; i <= 1000; ++i) {
    EXPECT_NE(sequentialColour(i / 1000.0), kNoValueColour);
    EXPECT_NE(divergingColour(i / 500.0 - 1.0), kNoValueColour);
  }
}

}  // namespace
}  // namespace irradiff
