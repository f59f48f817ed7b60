#include "experiments/figures/picture_preview.h"

#include "tests/figures/small_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace irradiff {
namespace {

using Place = std::pair<std::size_t, std::size_t>;

/// Where `part`, each of its pixels a square of `scale`, stands in `whole`.
std::optional<Place> find(const RgbImage& whole, const RgbImage& part, std::size_t scale) {
  const std::size_t width = part.width * scale;
  const std::size_t height = part.height * scale;
  for (std::size_t row = 0; row + height <= whole.height; ++row) {
    for (std::size_t column = 0; column + width <= whole.width; ++column) {
      bool is_here = true;
      for (std::size_t y = 0; is_here && y < height; ++y) {
        for (std::size_t x = 0; is_here && x < width; ++x) {
          is_here = whole.at(column + x, row + y) == part.at(x / scale, y / scale);
        }
      }
      if (is_here) {
        return Place{column, row};
      }
    }
  }
  return std::nullopt;
}

bool holds(const RgbImage& image, const Rgb& colour) { return std::ranges::count(image.pixels, colour) > 0; }

TEST(PicturePreview, HoldsTheMapAndItsBars) {
  for (const MapPicture& picture : mapPictures(plainMap(256, 40))) {
    const RgbImage image = preview(picture);
    const std::optional<Place> place = find(image, picture.image, 1);
    ASSERT_TRUE(place) << picture.name;
    EXPECT_GE(image.width, 256 + picture.bars.size() * 18) << picture.name;
    for (const ColourBar& bar : picture.bars) {
      EXPECT_TRUE(holds(image, bar.colours.front())) << picture.name;
      EXPECT_TRUE(holds(image, bar.colours.back())) << picture.name;
    }
  }
}

TEST(PicturePreview, EnlargesASmallMapByAWholeFactor) {
  const MapPicture picture = mapPictures(plainMap(100, 30))[0];
  const RgbImage image = preview(picture);
  EXPECT_TRUE(find(image, picture.image, 3));
  EXPECT_FALSE(find(image, picture.image, 2)) << "the bad twin: another factor would be found too";
  EXPECT_TRUE(find(preview(mapPictures(plainMap(1, 1))[0]), mapPictures(plainMap(1, 1))[0].image, 256));
}

TEST(PicturePreview, BarsRunUpwards) {
  const MapPicture picture = mapPictures(plainMap(300, 300))[0];
  const RgbImage image = preview(picture);
  const auto rowOf = [&](const Rgb& colour) {
    // To the right of the map.
    for (std::size_t row = 0; row < image.height; ++row) {
      for (std::size_t column = 320; column < image.width; ++column) {
        if (image.at(column, row) == colour) {
          return row;
        }
      }
    }
    return image.height;
  };
  const ColourBar& bar = picture.bars[0];
  EXPECT_LT(rowOf(bar.colours.back()), rowOf(bar.colours[bar.colours.size() / 2]));
  EXPECT_LT(rowOf(bar.colours[bar.colours.size() / 2]), rowOf(bar.colours.front()));
  EXPECT_LT(rowOf(bar.colours.front()), image.height);
}

}  // namespace
}  // namespace irradiff
