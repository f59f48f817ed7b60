#include "verification/report/figure_text.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/summary_text.h"

#include <algorithm>
#include <stdexcept>

namespace irradiff {
namespace {

std::string oracleCell(const ErratumMeasurement& m) {
  return escaped(m.oracle) + ", " + std::to_string(m.inputs) + (m.inputs == 1 ? " input" : " inputs");
}

/// Peak against the reference values of one family, in eps.
std::string referencePeak(const FormulaResults& formula, const std::string& family, Quantity quantity) {
  for (const Verdict& v : formula.verdicts) {
    const bool is_family = v.family == family || (formula.is_flatland && v.family == "flatland");
    if (v.check == "reference data" && is_family && v.quantity == quantity) {
      return epsilonText(v.peak);
    }
  }
  return "bound";
}

}  // namespace

std::string plotsSection(const AccuracyReport& report, const std::vector<SweepPlot>& plots) {
  if (plots.size() != 2 * report.sweeps.size()) {
    throw std::invalid_argument("the page needs two plots for each sweep");
  }
  std::string html = element("h2", "Error against size", "id=\"plots\"") + '\n';
  html +=
      element("p",
              "Relative errors against 200-digit values. Solid with points: the peak at that size; dotted: the "
              "median; dashed black: the largest bound that production reports with its results. Errors above 10, and "
              "results that are not numbers, are drawn at 10; errors below 1e-17 at 1e-17.") +
      '\n';
  for (std::size_t i = 0; i < report.sweeps.size(); ++i) {
    const ErrorSweep& sweep = report.sweeps[i];
    html += element("h3", escaped("By " + sweep.inputs->name)) + '\n';
    html += element("p", escaped(sweep.inputs->description + " " + std::to_string(sweep.samples_for_each_size) +
                                 " polygons at each size.")) +
            '\n';
    std::string figures;
    for (const SweepPlot* plot : {&plots[2 * i], &plots[2 * i + 1]}) {
      const std::string prefix = plot->file.substr(0, plot->file.find('.'));
      figures += element("figure", inlineSvg(plot->svg, prefix, plot->title)) + '\n';
    }
    html += element("div", figures, "class=\"plots\"") + '\n';
  }
  return html;
}

std::string errataSection(const AccuracyReport& report) {
  std::string html = element("h2", "Errata of the printed formulas", "id=\"errata\"") + '\n';
  html +=
      element("p",
              "J. Schwarzhaupt, H. W. Jensen, W. Jarosz, <cite>Practical Hessian-Based Error Control for Irradiance "
              "Caching</cite>, 2012. Each formula was evaluated as printed and as corrected; residuals are relative, "
              "against an oracle. They concern the formulas as printed, not the paper's results. Why: "
              "docs/errata.md.") +
      '\n';
  for (const Erratum& erratum : report.errata) {
    html += element("h3", escaped(erratum.equation + ": " + erratum.subject)) + '\n';
    html += element("p", element("b", "Printed: ") + escaped(erratum.printed) + "<br>" + element("b", "Corrected: ") +
                             escaped(erratum.corrected)) +
            '\n';
    HtmlTable table({"quantity", "residual as printed", "residual corrected", "oracle", "verdict"});
    for (const ErratumMeasurement& m : erratum.measurements) {
      table.add({escaped(m.quantity), escaped(printedText(m)), figureText(m.corrected_largest), oracleCell(m),
                 m.isConfirmed() ? badge("confirmed", "right") : badge("NOT CONFIRMED", "wrong")});
    }
    html += table.html();
    if (!erratum.remark.empty()) {
      html += element("p", escaped(erratum.remark), "class=\"soft\"") + '\n';
    }
  }
  return html;
}

std::string referencesSection(const AccuracyReport& report) {
  std::size_t cases = 0;
  HtmlTable table({"family", "cases", "routes", "gradient: peak [eps]", "Hessian: peak [eps]"});
  for (const ReferenceSummary& summary : report.references) {
    cases += summary.cases();
    std::string routes;
    for (const auto& [route, count] : summary.cases_by_route) {
      routes += (routes.empty() ? "" : ", ") + route + ' ' + std::to_string(count);
    }
    for (const FormulaResults& formula : report.formulas) {
      if (formula.is_promised && formula.is_flatland == (summary.dimension == 2)) {
        table.add({escaped(summary.family), std::to_string(summary.cases()), escaped(routes),
                   referencePeak(formula, summary.family, Quantity::kGradient),
                   referencePeak(formula, summary.family, Quantity::kHessian)});
      }
    }
  }
  std::string html = element("h2", "Reference values", "id=\"references\"") + '\n';
  html +=
      element(
          "p",
          countText(cases) +
              " cases in data/reference, 40 digits and an error bound each, inputs as exact doubles. They were made by "
              "rigorous enclosures of the defining integral (routes area, polar, line) and never by the formulas "
              "under test; a test regenerates them. Peak errors of production against them; <b>bound</b>: judged by "
              "the claimed bound alone.") +
      '\n';
  html += table.html();
  return html;
}

}  // namespace irradiff
