#include "verification/report/figure_text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace irradiff {

std::string figureText(double value) {
  if (std::isnan(value)) {
    return "not a number";
  }
  if (std::isinf(value)) {
    return "infinite";
  }
  std::array<char, 32> buffer{};
  const double size = std::abs(value);
  const char* format = value == 0.0 || (size >= 1e-3 && size < 1e3) ? "%.2g" : "%.1e";
  std::snprintf(buffer.data(), buffer.size(), size >= 99.5 && size < 1e3 ? "%.0f" : format, value);
  return buffer.data();
}

std::string epsilonText(double relative_error) { return figureText(relative_error / kEpsilon); }

std::string figureText(const std::optional<double>& value) { return value ? figureText(*value) : "-"; }

std::string epsilonText(const std::optional<double>& relative_error) {
  return relative_error ? epsilonText(*relative_error) : "-";
}

std::string countText(std::size_t count) {
  std::string text = std::to_string(count);
  for (std::size_t i = text.size(); i > 3; i -= 3) {
    text.insert(i - 3, 1, ' ');
  }
  return text;
}

}  // namespace irradiff
