#include "experiments/atlas/atlas_pictures.h"

#include "derivatives/scene/number_text.h"
#include "experiments/figures/colour_maps.h"
#include "experiments/figures/figure_sheet.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace irradiff {
namespace {

constexpr std::array<ScalarType, 3> kColumns = {ScalarType::kFloat, ScalarType::kDouble, ScalarType::kLongDouble};
constexpr std::size_t kSide = 384;

/// What the bitmap font can write.
std::string plain(std::string text) {
  std::erase_if(text, [](char c) { return c == ',' || c == ')'; });
  std::ranges::replace(text, '(', ' ');
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

double placeOnAxis(const AtlasAxis& axis, double fraction) {
  return axis.low * std::pow(axis.high / axis.low, fraction);
}

/// Draws where the region begins, two pixels inside it.
void outline(RgbImage& image, const StabilityMap& map, const SafeRegion& region, const Rgb& colour) {
  const auto contains = [&](std::size_t column, std::size_t row) {
    const auto fraction = [](std::size_t pixel) { return (static_cast<double>(pixel) + 0.5) / kSide; };
    return region.contains(placeOnAxis(map.x, fraction(column)), placeOnAxis(map.y, 1.0 - fraction(row)));
  };
  std::vector<bool> inside(kSide * kSide);
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) inside[row * kSide + column] = contains(column, row);
  }
  const auto is_outside = [&](std::size_t column, std::size_t row, int dx, int dy) {
    const long x = static_cast<long>(column) + dx;
    const long y = static_cast<long>(row) + dy;
    const auto side = static_cast<long>(kSide);
    return x >= 0 && y >= 0 && x < side && y < side && !inside[static_cast<std::size_t>(y * side + x)];
  };
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      if (!inside[row * kSide + column]) continue;
      bool is_border = false;
      for (const int step : {-2, -1, 1, 2}) {
        is_border = is_border || is_outside(column, row, step, 0) || is_outside(column, row, 0, step);
      }
      if (is_border) image.at(column, row) = colour;
    }
  }
}

RgbImage variantPicture(const StabilityMap& map, const VariantErrors& variant,
                        const std::vector<SafetyStatement>& statements, std::size_t quantity) {
  RgbImage image(kSide, kSide, {});
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      const std::size_t cell_row = (kSide - 1 - row) * map.cells / kSide;
      image.at(column, row) = errorColour(variant.peak[quantity][cell_row * map.cells + column * map.cells / kSide]);
    }
  }
  for (const SafetyStatement& s : statements) {
    if (s.map != map.file || s.formula != variant.formula || s.scalar != variant.scalar || s.quantity != quantity ||
        !s.region) {
      continue;
    }
    const auto tolerance =
        static_cast<std::size_t>(std::ranges::find(kAtlasTolerances, s.tolerance) - kAtlasTolerances.begin());
    outline(image, map, *s.region, kOutlineColours.at(tolerance));
  }
  return image;
}

/// The colours from left to right, and below them those that stand for no error.
SheetColumn legend(const StabilityMap& map, std::size_t quantity) {
  constexpr std::size_t kBand = 24;
  RgbImage image(kSide, 6 * kBand, {255, 255, 255});
  for (std::size_t row = 0; row < image.height; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      Rgb colour{255, 255, 255};
      if (row < kBand) {
        colour = errorColour(std::pow(kDarkestError, 1.0 - static_cast<double>(column) / (kSide - 1)));
      } else if (row < 2 * kBand) {
        colour = column < kSide / 2 ? kFailureColour : kNoValueColour;
      } else if (row >= 3 * kBand) {
        const std::size_t tolerance = row / kBand - 3;
        colour = row % kBand > 8 && row % kBand < 16 ? kOutlineColours.at(tolerance) : Rgb{60, 20, 90};
      }
      image.at(column, row) = colour;
    }
  }
  SheetColumn column{plain(kAtlasQuantityNames[quantity]), {image}, {}};
  column.lines = {"colours: 1e-20 to 1", "green: not finite", "grey: not held"};
  for (const double tolerance : kAtlasTolerances) column.lines.push_back("line: safe for " + numberText(tolerance));
  for (const auto& [word, axis] : {std::pair{"right: ", &map.x}, std::pair{"up: ", &map.y}}) {
    column.lines.push_back(plain(word + axis->name));
    column.lines.push_back(plain("  " + numberText(axis->low) + " to " + numberText(axis->high)));
  }
  return column;
}

}  // namespace

Rgb errorColour(double error) {
  if (std::isnan(error)) return kNoValueColour;
  if (std::isinf(error)) return kFailureColour;
  return sequentialColour(1.0 - std::log10(std::max(error, kDarkestError)) / std::log10(kDarkestError));
}

RgbImage atlasSheet(const StabilityMap& map, const std::vector<SafetyStatement>& statements, std::size_t quantity) {
  std::vector<std::vector<SheetColumn>> rows;
  std::vector<std::string> formulas;
  for (const VariantErrors& variant : map.variants) {
    if (std::ranges::find(formulas, variant.formula) == formulas.end()) formulas.push_back(variant.formula);
  }
  for (const std::string& formula : formulas) {
    std::vector<SheetColumn> row;
    for (const ScalarType scalar : kColumns) {
      const auto variant = std::ranges::find_if(
          map.variants, [&](const VariantErrors& v) { return v.formula == formula && v.scalar == scalar; });
      if (variant == map.variants.end()) continue;
      const std::string scalar_name = scalar == ScalarType::kLongDouble ? "long" : nameOf(scalar);
      row.push_back({plain(formula + ' ' + scalar_name), {variantPicture(map, *variant, statements, quantity)}, {}});
    }
    rows.push_back(std::move(row));
  }
  rows.back().push_back(legend(map, quantity));
  return figureSheet(rows);
}

std::string pictureFile(const StabilityMap& map, std::size_t quantity) {
  return map.file + '_' + plain(kAtlasQuantityNames[quantity]) + ".png";
}

}  // namespace irradiff
