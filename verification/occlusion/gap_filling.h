#pragma once

#include "verification/occlusion/scene_families.h"

#include <array>

namespace irradiff {

/// What the motion of apparent vertices is worth: the relative errors max|dH|/max|H| of the Hessian of the gap-filled
/// scene (the 2012 paper, section 4.1) over `count` scenes of a family, in the order of their indices. Both Hessians
/// are the library's; scenes in which nothing is partly hidden, or the Hessian does not exist or is zero, are left out.
std::vector<double> gapFillingErrors(const SceneFamily& family, std::size_t count, std::uint64_t seed);

/// Relative errors of the Hessian with apparent vertices fixed, as the gap-filled scene has them, and with their
/// motion.
struct GapFillingResiduals {
  double fixed;
  double moving;
};

/// The same scenes' residuals, of the library's Hessians against differences of irradiance in which everything that is
/// hidden is cut away anew at each place. A tenth of a second a scene.
std::vector<GapFillingResiduals> gapFillingResiduals(const SceneFamily& family, std::size_t count, std::uint64_t seed);

/// The shares of the errors in each decade: below 1e-8, 1e-8 to 1e-7, ... 1 to 10, from 10.
struct ErrorHistogram {
  static constexpr int kFirstDecade = -8;
  static constexpr int kDecades = 9;
  std::array<double, kDecades + 2> shares{};  ///< sum 1 if there is any error
};

ErrorHistogram histogramOf(const std::vector<double>& errors);

}  // namespace irradiff
