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

/// `percentile_99` is the least value that 99 % of the receivers do not exceed. Throws std::invalid_argument naming the
/// value and the rule unless there are as many of each, at least one, all finite, and the mean of the reference is
/// positive.
ImageError imageError(std::span<const double> irradiance, std::span<const double> reference);

}  // namespace irradiff
