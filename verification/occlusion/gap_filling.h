#pragma once

#include "verification/occlusion/scene_families.h"

#include <array>

namespace irradiff {

/// What the motion of apparent vertices is worth.
struct GapFillingErrors {
  /// max|dH|/max|H| of the Hessian of the gap-filled scene (the 2012 paper, section 4.1), for each scene with apparent
  /// vertices in the order of their indices.
  std::vector<double> errors;
  std::size_t without_vertices = 0;  ///< partly hidden scenes without any: their error is 0
};

/// Over `count` scenes of a family. Both Hessians are the library's; scenes in which nothing is partly hidden, or whose
/// Hessian does not exist or is zero, or which the library refuses, are left out.
GapFillingErrors gapFillingErrors(const SceneFamily& family, std::size_t count, std::uint64_t seed);

/// Relative errors of the Hessian with apparent vertices fixed, as the gap-filled scene has them, and with their
/// motion.
struct GapFillingResiduals {
  double fixed;
  double moving;
};

/// The same scenes' residuals, of the library's Hessians against differences of irradiance in which everything that is
/// hidden is cut away anew at each place. A tenth of a second a scene.
std::vector<GapFillingResiduals> gapFillingResiduals(const SceneFamily& family, std::size_t count, std::uint64_t seed);

/// The number of errors in each decade: below 1e-8, 1e-8 to 1e-7, ... 1 to 10, from 10.
struct ErrorHistogram {
  static constexpr int kFirstDecade = -8;
  static constexpr int kDecades = 9;
  std::array<std::size_t, kDecades + 2> counts{};

  /// The power of ten from which errors count in a bin; none for the first.
  static int decadeOf(std::size_t bin) { return kFirstDecade + static_cast<int>(bin) - 1; }
};

ErrorHistogram histogramOf(const std::vector<double>& errors);

}  // namespace irradiff
