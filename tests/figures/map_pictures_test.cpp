#include "experiments/figures/map_pictures.h"

#include "experiments/figures/colour_maps.h"
#include "tests/figures/small_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace irradiff {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

MapPicture pictureOf(const DerivativeMap& map, const std::string& name) {
  for (MapPicture& picture : mapPictures(map)) {
    if (picture.name == name) {
      return picture;
    }
  }
  ADD_FAILURE() << "there is no picture " << name;
  return {};
}

std::vector<double>& valuesOf(DerivativeMap& map, const std::string& name) {
  return std::ranges::find(map.channels, name, &MapChannel::name)->values;
}

TEST(MapPictures, AreThoseOfThePaperAndTheSingleChannels) {
  std::vector<std::string> names;
  for (const MapPicture& picture : mapPictures(plainMap(3, 2))) {
    names.push_back(picture.name);
    EXPECT_EQ(picture.image.width, 3U) << picture.name;
    EXPECT_EQ(picture.image.height, 2U) << picture.name;
    EXPECT_FALSE(picture.title.empty()) << picture.name;
    EXPECT_FALSE(picture.scaling.empty()) << picture.name;
    EXPECT_FALSE(picture.bars.empty()) << picture.name;
  }
  EXPECT_THAT(names, testing::ElementsAre("E", "gradient", "eigenvalues", "gradient.x", "gradient.y", "gradient.z",
                                          "hessian.xx", "hessian.xy", "hessian.yy", "lambda1", "lambda2", "lambda3",
                                          "gap.hessian", "event"));
}

TEST(MapPictures, RunFromTheLowerLeft) {
  // E is 0 in the lower left cell and 12 in the upper right one.
  const MapPicture picture = pictureOf(plainMap(3, 2), "E");
  EXPECT_EQ(picture.bars[0].low, 0.0);
  EXPECT_EQ(picture.bars[0].high, 12.0);
  EXPECT_EQ(picture.unit, "W/m^2");
  EXPECT_EQ(picture.image.at(0, 1), sequentialColour(0.0));
  EXPECT_EQ(picture.image.at(2, 1), sequentialColour(2.0 / 12));
  EXPECT_EQ(picture.image.at(0, 0), sequentialColour(10.0 / 12));
  EXPECT_EQ(picture.image.at(2, 0), sequentialColour(1.0));
}

TEST(MapPictures, EndAtANumberOfTwoDigits) {
  const auto high = [](double value) {
    DerivativeMap map = plainMap(1, 1);
    valuesOf(map, "E") = {value};
    return pictureOf(map, "E").bars[0].high;
  };
  EXPECT_EQ(high(1.0), 1.0);
  EXPECT_EQ(high(1.2000001), 1.3);
  EXPECT_EQ(high(0.0991), 0.1);
  EXPECT_EQ(high(9.9), 9.9);
  EXPECT_EQ(high(9.91), 10.0);
  EXPECT_EQ(high(123456), 130000.0);
  EXPECT_EQ(high(3.21e-9), 3.3e-9);
  EXPECT_EQ(high(0.0), 1.0) << "a black map has a scale too";
}

TEST(MapPictures, OfSignedValuesAreSymmetricAndSayWhatIsBeyond) {
  DerivativeMap map = plainMap(10, 10);
  std::vector<double>& values = valuesOf(map, "hessian.xy");
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = i % 2 == 0 ? -2.0 : 1.0;
  }
  EXPECT_THAT(pictureOf(map, "hessian.xy").scaling, testing::HasSubstr("Nothing is beyond."));
  values[0] = 1000;
  values[99] = kNan;
  const MapPicture picture = pictureOf(map, "hessian.xy");
  EXPECT_EQ(picture.bars[0].low, -2.0);
  EXPECT_EQ(picture.bars[0].high, 2.0);
  EXPECT_THAT(picture.scaling, testing::HasSubstr("1.01 % of the values are beyond")) << "1 of 99";
  EXPECT_EQ(picture.image.at(0, 9), divergingColour(1.0));
  EXPECT_EQ(picture.image.at(1, 9), divergingColour(0.5));
  EXPECT_EQ(picture.image.at(2, 9), divergingColour(-1.0));
  EXPECT_EQ(picture.image.at(9, 0), kNoValueColour);
}

TEST(MapPictures, MapTheGradientToRedAndGreen) {
  DerivativeMap map = plainMap(3, 1);
  valuesOf(map, "gradient.x") = {1, 0, -4};
  valuesOf(map, "gradient.y") = {-2, 0, kNan};
  const MapPicture picture = pictureOf(map, "gradient");
  ASSERT_EQ(picture.bars.size(), 2U);
  EXPECT_EQ(picture.bars[0].label, "red: gradient.x");
  EXPECT_EQ(picture.bars[1].label, "green: gradient.y");
  EXPECT_EQ(picture.bars[1].high, 4.0) << "one scale for both";
  // 255 (1/2 + v / (2 * 4)) to the nearest whole number.
  EXPECT_EQ(picture.image.at(0, 0), (Rgb{159, 64, 128}));
  EXPECT_EQ(picture.image.at(1, 0), (Rgb{128, 128, 128}));
  EXPECT_EQ(picture.image.at(2, 0), (Rgb{0, 0, 0})) << "no gradient";
}

TEST(MapPictures, MapTheEigenvaluesToRedGreenAndBlue) {
  const MapPicture picture = pictureOf(plainMap(2, 2), "eigenvalues");
  ASSERT_EQ(picture.bars.size(), 3U);
  EXPECT_EQ(picture.bars[2].label, "blue: lambda3");
  // 3, 1 and -4 of 4.
  EXPECT_EQ(picture.image.at(0, 0), (Rgb{223, 159, 0}));
}

TEST(MapPictures, HaveTheColoursOfTheirBars) {
  const DerivativeMap map = plainMap(4, 4);
  for (const MapPicture& picture : mapPictures(map)) {
    for (const ColourBar& bar : picture.bars) {
      EXPECT_LT(bar.low, bar.high) << picture.name;
      EXPECT_NE(bar.colours.front(), bar.colours.back()) << picture.name;
    }
  }
  const ColourBar bar = pictureOf(map, "gradient.y").bars[0];
  EXPECT_EQ(bar.colours.front(), divergingColour(-1.0));
  EXPECT_EQ(bar.colours[bar.colours.size() / 2], divergingColour(0.0));
  EXPECT_EQ(bar.colours.back(), divergingColour(1.0));
}

TEST(MapPictures, ShowEvents) {
  DerivativeMap map = plainMap(2, 1);
  valuesOf(map, "event") = {1, 0};
  const MapPicture picture = pictureOf(map, "event");
  EXPECT_EQ(picture.image.at(0, 0), picture.bars[0].colours[1]);
  EXPECT_EQ(picture.image.at(1, 0), picture.bars[0].colours[0]);
}

}  // namespace
}  // namespace irradiff
