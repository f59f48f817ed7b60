#include "experiments/pareto/spread.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace irradiff {

namespace {

std::string number(double value, int digits) {
  char text[64];
  // Digits behind the point only where they are few.
  if (value >= 100.0) {
    std::snprintf(text, sizeof text, "%.0f", value);
  } else {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
  }
  return text;
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {median, values.front(), values.back()};
}

std::string spreadText(const Spread& spread, int digits) {
  return number(spread.median, digits) + " (" + number(spread.low, digits) + " .. " + number(spread.high, digits) + ")";
}

}  // namespace irradiff
