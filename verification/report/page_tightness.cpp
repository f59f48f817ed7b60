#include "verification/report/html.h"
#include "verification/report/page_sections.h"

#include <algorithm>

namespace irradiff {

std::string tightnessSection(const AccuracyReport& report) {
  std::string html = element("h2", "Reported bounds over actual errors", "id=\"tightness\"") + '\n';
  html +=
      element(
          "p",
          "How many times the actual error the reported bound is: least, median, 99 % and largest over the inputs. "
          "The actual error is that against the same formula at 200 digits. Where it is 0 there is no ratio: such "
          "values are counted as exact and left out of the four figures, and so are those for which an evaluator "
          "claims no bound. Below 1 a bound would be wrong. Beyond double precision a value is rounded to double at "
          "the end, and its bound is that of this rounding. In double a bound covers the worst case of every "
          "rounding, and most errors are far from it.") +
      '\n';
  const std::vector<BoundTightness> broken = brokenBounds(report);
  html += element("p", broken.empty() ? badge("every bound holds", "right")
                                      : badge(std::to_string(broken.size()) + " bounds are exceeded", "wrong")) +
          '\n';
  for (const TightnessTable& of_one : tightnessTables(report.tightness)) {
    HtmlTable table(
        {"family", "values", "irradiance", "gradient", "Hessian", "tangential Hessian", "rotational gradient"});
    for (const std::vector<BoundTightness>& family : of_one.families) {
      const auto most = std::ranges::max_element(family, {}, &BoundTightness::values);
      std::vector<std::string> cells{escaped(most->family), std::to_string(most->values)};
      for (const BoundTightness& t : family) {
        cells.push_back(t.holds() ? escaped(figuresOf(t)) : badge(figuresOf(t), "wrong"));
      }
      table.add(cells);
    }
    html += element("h3", escaped(of_one.evaluator + ": " + nameOf(of_one.inputs))) + '\n' + table.html();
  }
  return html;
}

}  // namespace irradiff
