#include "verification/report/summary_text.h"

#include "verification/report/check_legend.h"
#include "verification/report/figure_text.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>

namespace irradiff {
namespace {

void raiseWorst(std::optional<double>& worst, const std::optional<double>& value) {
  if (value) {
    raiseTo(worst, *value);
  }
}

std::string withEpsilons(const std::optional<double>& error) {
  return figureText(error) + " (" + epsilonText(error) + " eps)";
}

}  // namespace

std::vector<std::string> summarySentences(const AccuracyReport& report) {
  std::optional<double> plain;
  std::optional<double> extreme;
  std::optional<double> unpromised;
  std::optional<double> over_bound;
  std::size_t checks = 0;
  std::size_t comparisons = 0;
  std::set<std::string_view> kinds;
  for (const FormulaResults& formula : report.formulas) {
    if (!formula.is_promised) {
      continue;
    }
    for (const Headline& h : headlinesOf(formula)) {
      raiseWorst(plain, h.well_conditioned_peak);
      raiseWorst(extreme, h.extreme_peak);
      raiseWorst(over_bound, h.worst_over_bound);
      checks += h.checks;
      comparisons += h.comparisons;
    }
    for (const Verdict& verdict : formula.unjudged) {
      raiseTo(unpromised, verdict.peak);
    }
    for (const Verdict& verdict : formula.verdicts) {
      kinds.insert(explanationOf(verdict.check).check);
    }
  }
  const std::size_t broken = brokenPromises(report).size();
  const std::size_t unconfirmed = unconfirmedErrata(report).size();
  std::vector<std::string> sentences;
  sentences.push_back(broken == 0 ? "All " + countText(checks) + " checks of the promised formulas passed."
                                  : "WRONG: " + countText(broken) + " of " + countText(checks) +
                                        " checks of the promised formulas failed.");
  sentences.push_back("Worst relative error on well-conditioned inputs: " + withEpsilons(plain) + ", asked 2e-14.");
  sentences.push_back("Worst over all other promised families: " + withEpsilons(extreme) + ", asked 1e-13.");
  sentences.push_back("The error was never more than " + figureText(over_bound) +
                      " of the bound reported with the result, asked at most 1.");
  if (over_bound && !(*over_bound <= 1.0)) {
    sentences.back() = "The reported error bound was exceeded: the error was up to " + figureText(*over_bound) +
                       " of it, asked at most 1.";
  }
  if (unpromised) {
    sentences.push_back(
        "Where only that bound is promised (slivers, extremes that meet, gradients near the polygon's plane, the "
        "tangential Hessian close over a polygon), errors reached " +
        figureText(unpromised) + ".");
  }
  sentences.push_back(countText(comparisons) + " values were compared, by " + std::to_string(kinds.size()) +
                      " kinds of check: oracles, closed forms and invariants.");
  if (!report.tightness.empty()) {
    std::size_t values = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const BoundTightness& t : report.tightness) {
      values += t.compared();
      if (t.compared() > 0) least = std::min(least, t.least);
    }
    const std::size_t exceeded = brokenBounds(report).size();
    sentences.push_back(
        exceeded == 0 ? "Reported bounds were measured on " + countText(values) +
                            " values: none is below the actual error, the least is " + figureText(least) + " times it."
                      : "WRONG: " + countText(exceeded) + " reported bounds are below the actual error, the least is " +
                            figureText(least) + " times it.");
  }
  sentences.push_back(unconfirmed == 0 ? "All " + countText(report.errata.size()) +
                                             " errata of the 2012 paper are confirmed by measurement."
                                       : "WRONG: " + countText(unconfirmed) + " of " + countText(report.errata.size()) +
                                             " errata of the 2012 paper are not borne out by measurement.");
  return sentences;
}

std::string plainText(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) {
    text += (text.empty() ? "" : " ") + sentence;
  }
  return text;
}

std::string quantityText(const FormulaResults& formula, Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
      return formula.is_flatland ? "irradiance" : "form factor";
    case Quantity::kGradient:
      return "gradient";
    case Quantity::kHessian:
      return "Hessian";
    case Quantity::kTangentialHessian:
      return "tangential Hessian";
    case Quantity::kRotationalGradient:
      return "rotational gradient";
    case Quantity::kIrradiance:
      return "irradiance";
  }
  return "";
}

std::string verdictText(const FormulaResults& formula, const Headline& headline) {
  if (headline.checks == 0) {
    return "not checked";
  }
  if (headline.failed == 0) {
    return formula.is_promised ? "holds" : "no promise; all checks met";
  }
  const std::string share = std::to_string(headline.failed) + " of " + std::to_string(headline.checks) + " checks";
  return formula.is_promised ? "WRONG: " + share + " failed" : "no promise; " + share + " not met";
}

std::string printedText(const ErratumMeasurement& m) {
  const std::string smallest = figureText(m.printed_smallest);
  const std::string largest = figureText(m.printed_largest);
  return smallest == largest ? largest : smallest + " to " + largest;
}

}  // namespace irradiff
