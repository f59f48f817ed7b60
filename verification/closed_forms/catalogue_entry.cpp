#include "verification/closed_forms/catalogue_entry.h"

#include <cmath>
#include <limits>

namespace irradiff::closed_forms {

void checkParameters(std::string_view title, std::span<const ParameterRange> ranges, std::span<const double> values) {
  std::ostringstream message;
  message.precision(std::numeric_limits<double>::max_digits10);
  message << "closed form \"" << title << "\": ";
  if (values.size() != ranges.size()) {
    message << values.size() << " parameters given, but it takes " << ranges.size();
    throw std::invalid_argument(message.str());
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const ParameterRange& range = ranges[i];
    const bool inside = values[i] >= range.lower && values[i] <= range.upper;  // false for NaN
    if (inside && (!range.integer || values[i] == std::floor(values[i]))) continue;
    message << "parameter " << range.name << " = " << values[i] << " must be " << (range.integer ? "an integer " : "")
            << "in [" << range.lower << ", " << range.upper << "]";
    throw std::invalid_argument(message.str());
  }
}

Polygon polygonOf(std::string_view title, std::vector<Eigen::Vector3d> vertices) {
  return {std::string(title), std::move(vertices), 1.0};
}

double stripHalfLength(double distance) { return std::scalbn(1.0, std::ilogb(std::max(distance, 1.0)) + 21); }

}  // namespace irradiff::closed_forms
