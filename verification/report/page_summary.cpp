#include "verification/report/check_legend.h"
#include "verification/report/figure_text.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/summary_text.h"

#include <cmath>

namespace irradiff {
namespace {

std::string verdictBadge(const FormulaResults& formula, const Headline& headline) {
  const std::string kind =
      !formula.is_promised ? "none" : (headline.failed == 0 && headline.checks > 0 ? "right" : "wrong");
  return badge(verdictText(formula, headline), kind);
}

std::string headlineTable(const AccuracyReport& report) {
  HtmlTable table({"formula", "verdict", "worst error, well-conditioned (asked 2e-14)",
                   "worst error, all other families (asked 1e-13)", "error / claimed bound (at most 1)",
                   "values compared"});
  for (const FormulaResults& formula : report.formulas) {
    for (const Headline& h : headlinesOf(formula)) {
      table.add({escaped(formula.name + ": " + quantityText(formula, h.quantity)), verdictBadge(formula, h),
                 figureText(h.well_conditioned_peak), figureText(h.extreme_peak), figureText(h.worst_over_bound),
                 countText(h.comparisons)});
    }
  }
  return table.html();
}

std::string failureList(const AccuracyReport& report) {
  std::string html;
  for (const Verdict& verdict : brokenPromises(report)) {
    html += element("pre", escaped(describe(verdict))) + '\n';
  }
  return html.empty() ? html : element("h3", "What is wrong") + '\n' + html;
}

}  // namespace

std::string summarySection(const AccuracyReport& report, const RunRecord& record) {
  const bool is_right = exitStatusOf(report) == 0;
  std::string sentences;
  for (const std::string& sentence : summarySentences(report)) {
    sentences += element("p", escaped(sentence));
  }
  std::string html = element("div", sentences, is_right ? "class=\"verdict right\"" : "class=\"verdict wrong\"") + '\n';
  html += failureList(report);
  html +=
      element("p",
              "Checked: the irradiance of a receiver from a polygon, its gradient and its Hessian with respect to the "
              "receiver's position, the part of the Hessian in the receiver's tangent plane and the rotational "
              "gradient, in double precision, the receiver's horizon included; nothing hides the polygon. "
              "No check sees every mistake, so there are several; what each can and cannot see is said <a "
              "href=\"#legend\">below</a>.") +
      '\n';
  html +=
      element("p",
              "Production is what <code>irradiff evaluate</code> uses. The other formulas promise nothing here: they "
              "show what the choice of formula is worth. F itself is held to 2e-14 on well-conditioned inputs and to "
              "its claimed bound elsewhere.") +
      '\n';
  html += headlineTable(report);
  html += element("p",
                  escaped("Effort " + std::string(nameOf(report.effort)) + ", seed " + std::to_string(report.seed) +
                          ", version " + record.version + ", " + record.date + ", " + record.compiler + ", " +
                          record.machine + ", " + std::to_string(record.threads) + " threads, " +
                          std::to_string(std::lround(record.wall_seconds)) + " s."),
                  "class=\"soft\"") +
          '\n';
  return html;
}

std::string legendSection() {
  std::string html = element("h2", "How to read this", "id=\"legend\"") + '\n';
  html +=
      element("ul",
              element("li",
                      "An <b>error</b> is norm-wise: the largest difference of a component, over the largest "
                      "component of the true value (for the rotational gradient, of it and F together: they are one "
                      "vector). A component that is tiny beside the others may be less "
                      "accurate than that.") +
                  element("li",
                          "<b>eps</b> = 2<sup>-52</sup> = 2.2e-16, the spacing of doubles at 1. An error of 10 "
                          "eps leaves 14 to 15 digits.") +
                  element("li",
                          "<b>Asked</b> is the promise, fixed before measuring: 2e-14 (90 eps) on "
                          "well-conditioned polygons, 1e-13 (450 eps) on the hard families. <b>Bound</b>: no "
                          "figure is promised, only that the error is at most the bound reported with the "
                          "result.") +
                  element("li", "The receiver's coordinates and normal and the vertices are taken as exact doubles.") +
                  element("li",
                          "Inputs are random with a fixed seed, so a peak is the worst that was found, not a "
                          "proof for all inputs. The claimed bounds are derived, and tested here.")) +
      '\n';
  HtmlTable table({"check", "what it catches", "what it cannot see"});
  for (const CheckExplanation& e : checkLegend()) {
    table.add({escaped(e.check), escaped(e.catches), escaped(e.misses)});
  }
  html += element("details", element("summary", "What each check can and cannot see") + table.html()) + '\n';
  return html;
}

}  // namespace irradiff
