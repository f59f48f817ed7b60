#pragma once

#include "experiments/io/png_file.h"

namespace irradiff {

/// Colour of an amount, t from 0 (near black, violet) over red to 1 (near white, yellow); beyond, that of the nearer
/// end. Made in OKLab (B. Ottosson, "A perceptual color space for image processing", 2020), in which its lightness
/// grows evenly, so that equal steps look alike and a print in greys keeps the order.
Rgb sequentialColour(double t);

/// Colour of a signed value, t from -1 (blue) over 0 (near white, neutral) to 1 (red); beyond, that of the nearer end.
/// Equally dark on both sides, evenly in OKLab.
Rgb divergingColour(double t);

/// Where there is no value, NaN in the above: a grey that neither of them has otherwise.
inline constexpr Rgb kNoValueColour{128, 128, 128};

}  // namespace irradiff
