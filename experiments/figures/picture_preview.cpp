#include "experiments/figures/picture_preview.h"

#include "derivatives/scene/number_text.h"
#include "experiments/figures/bitmap_font.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

constexpr std::size_t kSmallestSide = 256;
constexpr std::size_t kTextScale = 2;
constexpr std::size_t kLineHeight = kGlyphHeight * kTextScale;
constexpr std::size_t kMargin = 10;
constexpr std::size_t kBarWidth = 18;
constexpr std::size_t kShortestBar = 5 * kLineHeight;
constexpr Rgb kPaper{255, 255, 255};
constexpr Rgb kFrame{128, 128, 128};

/// Where a value stands on a bar, as a share of its length from below.
using BarLabels = std::vector<std::pair<double, std::string>>;

BarLabels labelsOf(const ColourBar& bar) {
  BarLabels labels{{0.0, numberText(bar.low)}, {1.0, numberText(bar.high)}};
  // Between the two colours of a flag there is nothing.
  if (bar.colours.size() > 2) {
    labels.emplace_back(0.5, numberText(0.5 * (bar.low + bar.high)));
  }
  return labels;
}

std::size_t widthOf(const ColourBar& bar) {
  std::size_t text = 0;
  for (const auto& [place, label] : labelsOf(bar)) {
    text = std::max(text, textWidth(label, kTextScale));
  }
  return kMargin + std::max(kBarWidth + kMargin / 2 + text, textWidth(bar.label, kTextScale));
}

/// A line around a rectangle, one pixel outside of it: white is a colour of maps and bars too.
void drawFrame(RgbImage& image, std::size_t column, std::size_t row, std::size_t width, std::size_t height) {
  for (std::size_t x = column - 1; x <= column + width; ++x) {
    image.at(x, row - 1) = image.at(x, row + height) = kFrame;
  }
  for (std::size_t y = row - 1; y <= row + height; ++y) {
    image.at(column - 1, y) = image.at(column + width, y) = kFrame;
  }
}

/// The bar from `row` down to `end`, its label above where it has one.
void drawBar(RgbImage& image, const ColourBar& bar, std::size_t column, std::size_t row, std::size_t end) {
  if (!bar.label.empty()) {
    drawText(image, bar.label, column, row, kTextScale);
    row += kLineHeight + kMargin / 2;
  }
  const std::size_t length = end - row;
  for (std::size_t y = 0; y < length; ++y) {
    const std::size_t step = (length - 1 - y) * bar.colours.size() / length;
    for (std::size_t x = 0; x < kBarWidth; ++x) {
      image.at(column + x, row + y) = bar.colours[step];
    }
  }
  drawFrame(image, column, row, kBarWidth, length);
  for (const auto& [place, label] : labelsOf(bar)) {
    const auto below_top = static_cast<std::size_t>((1.0 - place) * static_cast<double>(length - kLineHeight));
    drawText(image, label, column + kBarWidth + kMargin / 2, row + below_top, kTextScale);
  }
}

std::size_t scaleOf(const RgbImage& image) {
  const std::size_t side = std::max(image.width, image.height);
  return (kSmallestSide + side - 1) / side;
}

void drawEnlarged(RgbImage& target, const RgbImage& image, std::size_t column, std::size_t row, std::size_t scale) {
  for (std::size_t y = 0; y < image.height * scale; ++y) {
    for (std::size_t x = 0; x < image.width * scale; ++x) {
      target.at(column + x, row + y) = image.at(x / scale, y / scale);
    }
  }
  drawFrame(target, column, row, image.width * scale, image.height * scale);
}

}  // namespace

RgbImage preview(const MapPicture& picture) {
  const std::string title = picture.name + (picture.unit.empty() ? "" : " in " + picture.unit);
  const std::size_t scale = scaleOf(picture.image);
  const std::size_t first_row = kMargin + kLineHeight + kMargin;
  const std::size_t last_row =
      first_row + std::max(picture.image.height * scale, kLineHeight + kMargin / 2 + kShortestBar);
  std::size_t width = kMargin + picture.image.width * scale;
  for (const ColourBar& bar : picture.bars) {
    width += widthOf(bar);
  }
  RgbImage image(std::max(width, kMargin + textWidth(title, kTextScale)) + kMargin, last_row + kMargin, kPaper);
  drawText(image, title, kMargin, kMargin, kTextScale);
  drawEnlarged(image, picture.image, kMargin, first_row, scale);
  std::size_t column = kMargin + picture.image.width * scale;
  for (const ColourBar& bar : picture.bars) {
    drawBar(image, bar, column + kMargin, first_row, last_row);
    column += widthOf(bar);
  }
  return image;
}

}  // namespace irradiff
