#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace irradiff {

/// How fast errors fall: the slope of the least-squares line through log(size) and -log(error).
inline double convergenceOrder(std::span<const std::size_t> sizes, std::span<const double> errors) {
  const auto count = static_cast<double>(sizes.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    mean_x += std::log(static_cast<double>(sizes[i])) / count;
    mean_y -= std::log(errors[i]) / count;
  }
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double x = std::log(static_cast<double>(sizes[i])) - mean_x;
    products += x * (-std::log(errors[i]) - mean_y);
    squares += x * x;
  }
  return products / squares;
}

}  // namespace irradiff
