#include "experiments/atlas/atlas_pictures.h"

#include "experiments/figures/colour_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace irradiff {
namespace {

int lightness(const Rgb& colour) { return colour.red + colour.green + colour.blue; }

TEST(ErrorColour, IsLighterForLargerErrorsAndTellsFailures) {
  EXPECT_LT(lightness(errorColour(1e-16)), lightness(errorColour(1e-7)));
  EXPECT_LT(lightness(errorColour(1e-7)), lightness(errorColour(1e-1)));
  EXPECT_EQ(errorColour(0.0), errorColour(kDarkestError));
  EXPECT_EQ(errorColour(1e9), errorColour(1.0));
  EXPECT_EQ(errorColour(std::numeric_limits<double>::infinity()), kFailureColour);
  EXPECT_EQ(errorColour(std::numeric_limits<double>::quiet_NaN()), kNoValueColour);
  for (double error = 1e-20; error < 10.0; error *= 1.3) {
    EXPECT_FALSE(errorColour(error) == kFailureColour || errorColour(error) == kNoValueColour);
  }
}

std::ptrdiff_t countOf(const RgbImage& image, const Rgb& colour) { return std::ranges::count(image.pixels, colour); }

TEST(AtlasSheet, ShowsCellsAndOutlines) {
  StabilityMap map;
  map.file = "map";
  map.x = {"a", 1e-2, 1e2};
  map.y = {"b", 1e-2, 1e2};
  map.cells = 2;
  map.variants = {{"appendix, acos", ScalarType::kDouble, {}}};
  for (std::vector<double>& peak : map.variants[0].peak) {
    peak = {1e-9, 1e-5, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()};
  }
  const RgbImage plain = atlasSheet(map, {}, 1);
  EXPECT_GT(countOf(plain, errorColour(1e-5)), 10000);
  const std::ptrdiff_t without = countOf(plain, kOutlineColours[1]);
  SafetyStatement statement{"map", "appendix, acos", ScalarType::kDouble, 1, 1e-6, SafeRegion{}, 0, 0};
  statement.region->inequalities = {{1, 0, false, 0.5}, {0, 1, false, 0.5}};
  const RgbImage outlined = atlasSheet(map, {statement}, 1);
  EXPECT_GT(countOf(outlined, kOutlineColours[1]), without + 200);
  EXPECT_EQ(countOf(atlasSheet(map, {statement}, 2), kOutlineColours[1]), without) << "of another quantity";
  EXPECT_EQ(pictureFile(map, 2), "map_hessian.png");
}

}  // namespace
}  // namespace irradiff
