#pragma once

#include "experiments/io/png_file.h"

#include <string>
#include <vector>

namespace irradiff {

/// A column of a sheet: pictures one below the other and lines of text below them.
struct SheetColumn {
  std::string title;
  std::vector<RgbImage> pictures;
  std::vector<std::string> lines;
};

/// Rows of columns on white, as a printed figure. Pictures smaller than kSheetPicture are enlarged by a whole factor.
/// Texts are of what bitmap_font.h has; too long ones are cut off.
RgbImage figureSheet(const std::vector<std::vector<SheetColumn>>& rows);

inline constexpr std::size_t kSheetPicture = 256;

}  // namespace irradiff
