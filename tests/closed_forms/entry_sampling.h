#pragma once

#include "verification/closed_forms/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace irradiff::closed_forms_test {

/// Seed of every random test of this folder; a failure prints the parameters in full.
inline constexpr std::uint64_t kSeed = 20120617;

/// Parameter sets for each entry: 20, times IRRADIFF_TEST_MULTIPLIER.
inline int parameterSets() {
  const char* multiplier = std::getenv("IRRADIFF_TEST_MULTIPLIER");
  return 20 * (multiplier == nullptr ? 1 : std::max(1, std::atoi(multiplier)));
}

/// A point of the box of ranges, on a grid of 2^-16 so that configurations are exact; log-uniform where a range spans
/// more than a factor of 8. The same bits on every platform.
inline std::vector<double> drawParameters(const std::vector<ParameterRange>& ranges, std::mt19937_64& random) {
  std::vector<double> values;
  for (const ParameterRange& range : ranges) {
    const double fraction = static_cast<double>(random() >> 11) * 0x1p-53;
    double value = range.lower + fraction * (range.upper - range.lower);
    if (range.lower > 0 && range.upper > 8 * range.lower) {
      value = range.lower * std::exp2(fraction * std::log2(range.upper / range.lower));
    }
    const double grid = range.integer ? 1.0 : 0x1p-16;
    values.push_back(std::clamp(std::round(value / grid) * grid, range.lower, range.upper));
  }
  return values;
}

}  // namespace irradiff::closed_forms_test
