#include "experiments/figures/figure_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace irradiff {
namespace {

constexpr Rgb kRed{200, 0, 0};
constexpr Rgb kBlue{0, 0, 200};
constexpr Rgb kBlack{0, 0, 0};

/// The rectangle that holds all pixels of a colour.
struct Extent {
  std::size_t left = SIZE_MAX, right = 0, top = SIZE_MAX, bottom = 0;
};

Extent extentOf(const RgbImage& image, const Rgb& colour) {
  Extent extent;
  for (std::size_t row = 0; row < image.height; ++row) {
    for (std::size_t column = 0; column < image.width; ++column) {
      if (!(image.at(column, row) == colour)) continue;
      extent.left = std::min(extent.left, column);
      extent.right = std::max(extent.right, column + 1);
      extent.top = std::min(extent.top, row);
      extent.bottom = std::max(extent.bottom, row + 1);
    }
  }
  return extent;
}

TEST(FigureSheet, SetsColumnsSideBySideAndRowsBelow) {
  const RgbImage red(64, 32, kRed);
  const RgbImage blue(256, 256, kBlue);
  const RgbImage sheet = figureSheet({{{"one", {red}, {}}, {"two", {blue}, {"median 0.5"}}}, {{"three", {red}, {}}}});
  const Extent of_blue = extentOf(sheet, kBlue);
  EXPECT_EQ(of_blue.right - of_blue.left, 256U);
  EXPECT_EQ(of_blue.bottom - of_blue.top, 256U);
  const Extent of_red = extentOf(sheet, kRed);
  EXPECT_EQ(of_red.right - of_red.left, 256U) << "enlarged four times";
  EXPECT_LE(of_red.right, of_blue.left);
  EXPECT_GT(of_red.bottom, of_blue.bottom) << "the second row";
  const Extent text = extentOf(sheet, kBlack);
  EXPECT_LT(text.top, of_blue.top) << "titles";
  EXPECT_LE(text.right, sheet.width);
}

TEST(FigureSheet, CutsOffWhatIsTooLong) {
  const RgbImage red(256, 8, kRed);
  const std::string name(200, 'w');
  const RgbImage sheet = figureSheet({{{name, {red}, {name}}}});
  EXPECT_LE(extentOf(sheet, kBlack).right, extentOf(sheet, kRed).right);
}

}  // namespace
}  // namespace irradiff
