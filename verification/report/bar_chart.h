#pragma once

#include <string>
#include <vector>

namespace irradiff {

/// A bar of a chart, over its label and under its figure.
struct Bar {
  std::string label;
  double amount;  ///< not negative
  std::string figure;
};

/// Bars side by side as an svg element of a page, the tallest as high as the chart; `description` is for those who do
/// not see it.
std::string barChart(const std::vector<Bar>& bars, const std::string& description);

}  // namespace irradiff
