#include "verification/report/bar_chart.h"

#include "verification/report/html.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

std::string barChart(const std::vector<Bar>& bars, const std::string& description) {
  constexpr int kWidth = 60;
  constexpr int kHeight = 120;
  double most = 0.0;
  for (const Bar& bar : bars) most = std::max(most, bar.amount);
  std::string drawn;
  int x = 0;
  for (const Bar& bar : bars) {
    const int height = most > 0.0 ? static_cast<int>(std::lround(kHeight * bar.amount / most)) : 0;
    const auto centred = [&](const std::string& text, int y) {
      return element(
          "text", escaped(text),
          "x=\"" + std::to_string(x + kWidth / 2) + "\" y=\"" + std::to_string(y) + "\" text-anchor=\"middle\"");
    };
    drawn += "<rect x=\"" + std::to_string(x + 4) + "\" y=\"" + std::to_string(20 + kHeight - height) + "\" width=\"" +
             std::to_string(kWidth - 8) + "\" height=\"" + std::to_string(height) + "\" fill=\"#4a6fa5\"/>";
    drawn += centred(bar.figure, 16 + kHeight - height) + centred(bar.label, 36 + kHeight);
    x += kWidth;
  }
  const std::string width = std::to_string(x);
  return element("svg", drawn,
                 "viewBox=\"0 0 " + width + ' ' + std::to_string(kHeight + 44) + "\" role=\"img\" aria-label=\"" +
                     escaped(description) + "\" style=\"max-width:" + width + "px;width:100%;font:11px sans-serif\"");
}

}  // namespace irradiff
