// Files are read back by libpng and compared pixel for pixel.

#include "experiments/io/png_file.h"

#include "tests/io/image_reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace irradiff {
namespace {

/// No two rows, columns or channels alike.
RgbImage colourful(std::size_t width, std::size_t height) {
  RgbImage image(width, height, {});
  for (std::size_t j = 0; j < height; ++j) {
    for (std::size_t i = 0; i < width; ++i) {
      image.at(i, j) = {static_cast<std::uint8_t>(7 * i + j), static_cast<std::uint8_t>(5 * j + 3 * i * i),
                        static_cast<std::uint8_t>(11 * i * j + 1)};
    }
  }
  return image;
}

TEST(PngFile, ReadsBackToTheSamePixels) {
  for (const auto& [width, height] : {std::pair<std::size_t, std::size_t>{1, 1}, {7, 3}, {64, 200}}) {
    const RgbImage image = colourful(width, height);
    const RgbImage again = readPng(pngFile(image));
    EXPECT_EQ(again.width, width);
    EXPECT_EQ(again.height, height);
    EXPECT_EQ(again.pixels, image.pixels);
  }
}

TEST(PngFile, NamesWhatItCannotHold) {
  EXPECT_THAT([] { pngFile(RgbImage()); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("an image of 0 x 0 with 0 pixels")));
  RgbImage torn = colourful(4, 4);
  torn.pixels.pop_back();
  EXPECT_THAT([&] { pngFile(torn); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("4 x 4 with 15 pixels")));
}

}  // namespace
}  // namespace irradiff
