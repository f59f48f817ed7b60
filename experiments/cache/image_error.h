#pragma once

#include <cstddef>
#include <span>

namespace irradiff {

/// How wrong interpolated irradiance is over all receivers, relative to the mean of the reference.
struct ImageError {
  double rms = 0.0;
  double percentile_99 = 0.0;  ///< of |error|
  double maximum = 0.0;
};

/// Requires as many of each, at least one, and a positive mean.
ImageError imageError(std::span<const double> irradiance, std::span<const double> reference);

}  // namespace irradiff
