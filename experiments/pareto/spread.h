#pragma once

#include <string>
#include <vector>

namespace irradiff {

/// Of repeated measurements.
struct Spread {
  double median = 0.0;
  double low = 0.0;   ///< the smallest
  double high = 0.0;  ///< the largest
};

/// Requires a value.
Spread spreadOf(std::vector<double> values);

/// "1.52 (1.49 .. 1.60)".
std::string spreadText(const Spread& spread, int digits);

}  // namespace irradiff
