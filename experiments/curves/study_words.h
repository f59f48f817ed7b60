#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace irradiff {

/// In a table, where there is no number.
inline constexpr const char* kNothing = "-";

inline std::string threeDigits(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? kNothing : "infinite";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// "a, b and c".
inline std::string listText(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
  }
  return text;
}

}  // namespace irradiff
