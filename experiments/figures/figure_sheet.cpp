#include "experiments/figures/figure_sheet.h"

#include "experiments/figures/bitmap_font.h"

#include <algorithm>
#include <cstddef>

namespace irradiff {
namespace {

constexpr std::size_t kTextScale = 2;
constexpr std::size_t kLine = kGlyphHeight * kTextScale + 4;
constexpr std::size_t kGap = 12;
constexpr Rgb kPaper{255, 255, 255};

std::size_t scaleOf(const RgbImage& image) {
  const std::size_t side = std::max(image.width, image.height);
  return (kSheetPicture + side - 1) / side;
}

std::size_t widthOf(const SheetColumn& column) {
  std::size_t width = kSheetPicture;
  for (const RgbImage& picture : column.pictures) width = std::max(width, picture.width * scaleOf(picture));
  return width;
}

std::size_t heightOf(const SheetColumn& column) {
  std::size_t height = kLine;
  for (const RgbImage& picture : column.pictures) height += picture.height * scaleOf(picture) + kGap;
  return height + column.lines.size() * kLine;
}

void drawCut(RgbImage& sheet, std::string text, std::size_t column, std::size_t row, std::size_t width) {
  while (textWidth(text, kTextScale) > width) text.pop_back();
  drawText(sheet, text, column, row, kTextScale);
}

void drawColumn(RgbImage& sheet, const SheetColumn& column, std::size_t left, std::size_t top) {
  const std::size_t width = widthOf(column);
  drawCut(sheet, column.title, left, top, width);
  std::size_t row = top + kLine;
  for (const RgbImage& picture : column.pictures) {
    const std::size_t scale = scaleOf(picture);
    for (std::size_t y = 0; y < picture.height * scale; ++y) {
      for (std::size_t x = 0; x < picture.width * scale; ++x) {
        sheet.at(left + x, row + y) = picture.at(x / scale, y / scale);
      }
    }
    row += picture.height * scale + kGap;
  }
  for (const std::string& line : column.lines) {
    drawCut(sheet, line, left, row, width);
    row += kLine;
  }
}

}  // namespace

RgbImage figureSheet(const std::vector<std::vector<SheetColumn>>& rows) {
  std::size_t width = 0;
  std::size_t height = kGap;
  std::vector<std::size_t> heights;
  heights.reserve(rows.size());
  for (const std::vector<SheetColumn>& row : rows) {
    std::size_t row_width = kGap;
    std::size_t row_height = 0;
    for (const SheetColumn& column : row) {
      row_width += widthOf(column) + kGap;
      row_height = std::max(row_height, heightOf(column));
    }
    width = std::max(width, row_width);
    heights.push_back(row_height);
    height += row_height + kGap;
  }
  RgbImage sheet(width, height, kPaper);
  std::size_t top = kGap;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::size_t left = kGap;
    for (const SheetColumn& column : rows[r]) {
      drawColumn(sheet, column, left, top);
      left += widthOf(column) + kGap;
    }
    top += heights[r] + kGap;
  }
  return sheet;
}

}  // namespace irradiff
