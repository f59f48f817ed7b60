#pragma once

#include "experiments/io/png_file.h"

#include <cstddef>
#include <string_view>

namespace irradiff {

/// Letters of 5 x 8 dots, the last row being that of descenders, for the labels of pictures; each dot is a square of
/// `scale` pixels. There are a to z, digits, a few capitals and signs: what names of channels, units and numbers are
/// made of.
inline constexpr std::size_t kGlyphHeight = 8;

/// Width of a text in pixels.
std::size_t textWidth(std::string_view text, std::size_t scale);

/// Draws a text in black, its upper left corner at (column, row). Throws std::invalid_argument naming a character that
/// has no glyph, and std::out_of_range if the text does not fit into the image.
void drawText(RgbImage& image, std::string_view text, std::size_t column, std::size_t row, std::size_t scale);

}  // namespace irradiff
