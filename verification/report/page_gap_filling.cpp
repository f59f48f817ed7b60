#include "verification/report/bar_chart.h"
#include "verification/report/figure_text.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace irradiff {
namespace {

/// "12.3 %" of `whole`, which is not 0.
std::string shareText(std::size_t part, std::size_t whole) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
  return text.data();
}

std::string labelOf(std::size_t bin) {
  return bin == 0 ? "less" : "10^" + std::to_string(ErrorHistogram::decadeOf(bin));
}

/// Errors in increasing order.
class SortedErrors {
 public:
  explicit SortedErrors(std::vector<double> errors) : errors_(std::move(errors)) { std::ranges::sort(errors_); }

  std::size_t count() const { return errors_.size(); }
  std::size_t countAbove(double limit) const {
    return static_cast<std::size_t>(errors_.end() - std::ranges::upper_bound(errors_, limit));
  }
  /// The largest that one in `n` or more reach; a dash if there are none.
  std::string reachedByOneIn(std::size_t n) const {
    return errors_.empty() ? "-" : figureText(errors_[errors_.size() - (errors_.size() + n - 1) / n]);
  }
  std::string chart(const std::string& description) const {
    const ErrorHistogram histogram = histogramOf(errors_);
    std::vector<Bar> bars;
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      bars.push_back({labelOf(i), static_cast<double>(histogram.counts[i]), shareText(histogram.counts[i], count())});
    }
    return barChart(bars, description);
  }

 private:
  std::vector<double> errors_;
};

std::string chartOfFamily(const GapFillingLosses& losses) {
  const SortedErrors errors(losses.losses.errors);
  if (errors.count() == 0) return "";
  const std::string caption = element("figcaption", escaped(losses.family));
  return element("figure", errors.chart("scenes of the family " + losses.family + " by error") + caption) + '\n';
}

}  // namespace

std::string gapFillingSection(const AccuracyReport& report) {
  std::string html = element("h2", "What filled gaps lose of the Hessian", "id=\"gap-filling\"") + '\n';
  std::vector<double> all;
  std::size_t without_vertices = 0;
  HtmlTable table({"scenes", "partly hidden", "no apparent vertex", "half lose at least", "one in ten at least",
                   "lose more than a tenth"});
  std::string charts;
  for (const GapFillingLosses& losses : report.gap_filling) {
    all.insert(all.end(), losses.losses.errors.begin(), losses.losses.errors.end());
    without_vertices += losses.losses.without_vertices;
    const SortedErrors errors(losses.losses.errors);
    table.add({escaped(losses.family) + element("span", ": " + escaped(losses.description), "class=\"soft\""),
               std::to_string(errors.count() + losses.losses.without_vertices),
               std::to_string(losses.losses.without_vertices), errors.reachedByOneIn(2), errors.reachedByOneIn(10),
               errors.count() == 0 ? "-" : shareText(errors.countAbove(0.1), errors.count())});
    charts += chartOfFamily(losses);
  }
  const SortedErrors errors(std::move(all));
  html += element("p",
                  "Section 4.1 of the 2012 paper fills the gaps behind silhouettes. Irradiance and gradient stay the "
                  "same; the Hessian loses the motion of the apparent vertices, where one edge passes behind another. "
                  "Its relative error max|dH|/max|H| in random scenes, both Hessians from the library's scene "
                  "evaluator:") +
          '\n';
  if (errors.count() == 0) {
    return html + element("p", "None of the scenes has an apparent vertex: nothing was measured.") + '\n';
  }
  html += errors.chart("scenes by error of the gap-filled Hessian") + '\n';
  html += element("p", "Scenes with apparent vertices by error: each bar from its power of ten to the next.",
                  "class=\"soft\"") +
          '\n';
  html += element("p", "Of " + countText(errors.count() + without_vertices) + " partly hidden scenes " +
                           countText(without_vertices) + " have no apparent vertex, and lose nothing. Of the other " +
                           countText(errors.count()) + " half lose at least " + errors.reachedByOneIn(2) +
                           " of the Hessian and one in ten at least " + errors.reachedByOneIn(10) + " of it; " +
                           shareText(errors.countAbove(0.1), errors.count()) + " lose more than a tenth.") +
          '\n';
  html += table.html();
  html +=
      element("details", element("summary", "The same by family") + element("div", charts, "class=\"plots\"")) + '\n';
  return html;
}

}  // namespace irradiff
