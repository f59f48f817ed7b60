#include "experiments/figures/bitmap_font.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

constexpr Rgb kWhite{255, 255, 255};

/// An image as text, '#' for ink.
std::string ink(const RgbImage& image) {
  std::string text;
  for (std::size_t j = 0; j < image.height; ++j) {
    for (std::size_t i = 0; i < image.width; ++i) {
      text += image.at(i, j) == kWhite ? '.' : '#';
    }
    text += '\n';
  }
  return text;
}

std::string drawn(const std::string& text, std::size_t scale = 1) {
  RgbImage image(textWidth(text, scale), kGlyphHeight * scale, kWhite);
  drawText(image, text, 0, 0, scale);
  return ink(image);
}

TEST(BitmapFont, DrawsLettersUpright) {
  EXPECT_EQ(drawn("E4"),
            "#####....#..\n"
            "#.......##..\n"
            "#......#.#..\n"
            "####..#..#..\n"
            "#.....#####.\n"
            "#........#..\n"
            "#####....#..\n"
            "............\n");
}

TEST(BitmapFont, EnlargesDots) { EXPECT_EQ(drawn(".", 2).substr(130, 26), "..####......\n..####......\n"); }

TEST(BitmapFont, TellsItsCharactersApart) {
  std::set<std::string> glyphs;
  const std::string characters = " +-./:^0123456789EWabcdefghijklmnopqrstuvwxyz";
  for (const char character : characters) {
    glyphs.insert(drawn(std::string(1, character)));
  }
  EXPECT_EQ(glyphs.size(), characters.size());
}

TEST(BitmapFont, RefusesWhatItCannotDraw) {
  EXPECT_THAT([] { drawn("5 %"); }, testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("character 37")));
  RgbImage image(20, 20, kWhite);
  EXPECT_THAT([&] { drawText(image, "four", 0, 0, 1); },
              testing::ThrowsMessage<std::out_of_range>(testing::HasSubstr("20 x 20 pixels")));
  EXPECT_THROW(drawText(image, "a", 0, 13, 1), std::out_of_range);
  EXPECT_NO_THROW(drawText(image, "a", 14, 12, 1));
}

}  // namespace
}  // namespace irradiff
