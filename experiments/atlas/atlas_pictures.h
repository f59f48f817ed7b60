#pragma once

#include "experiments/atlas/safe_region.h"
#include "experiments/io/png_file.h"

#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// Colours of errors: dark for 1e-20 and less to light for 1 and more, in the colours of sequentialColour.
inline constexpr double kDarkestError = 1e-20;
/// A result that was not finite, or none at all.
inline constexpr Rgb kFailureColour{0, 168, 150};

Rgb errorColour(double error);

/// Colours of the lines around the safe regions of kAtlasTolerances.
inline constexpr std::array<Rgb, kAtlasTolerances.size()> kOutlineColours = {Rgb{255, 255, 255}, Rgb{110, 200, 255},
                                                                             Rgb{150, 255, 120}};

/// All variants of a map: a row for each formula, a column for each scalar, and what the colours mean. x to the right,
/// y upwards, with the outlines of the safe regions.
RgbImage atlasSheet(const StabilityMap& map, const std::vector<SafetyStatement>& statements, std::size_t quantity);

/// "size_grazing_hessian.png".
std::string pictureFile(const StabilityMap& map, std::size_t quantity);

}  // namespace irradiff
