#include "verification/checks/input_families.h"
#include "verification/report/check_legend.h"
#include "verification/report/figure_text.h"
#include "verification/report/headline.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/summary_text.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace irradiff {
namespace {

std::string descriptionOf(const std::string& family) {
  for (const InputFamily& known : inputFamilies()) {
    if (known.name == family) {
      return std::string(known.description);
    }
  }
  for (const SweepInputs& sweep : sweepInputs()) {
    if ("sweep: " + sweep.name == family) {
      return sweep.description;
    }
  }
  return "";
}

/// "4.1 of 450": peak and promise in eps; "4.1 (bound)" where none but the claimed bound is promised.
std::string againstPromise(const FamilyLine& line, Quantity quantity) {
  const auto found = line.figures.find(quantity);
  if (found == line.figures.end() || !found->second.verdict) {
    // The sweeps are of gradient and Hessian alone.
    return line.family.starts_with("sweep: ") ? "-" : "bound";
  }
  const auto& [promise, verdict] = found->second;
  if (promise == 0.0) {
    return epsilonText(verdict->peak) + " (bound)";
  }
  const std::string text = epsilonText(verdict->peak) + " of " + epsilonText(promise);
  return verdict->passed ? text : element("b", text);
}

std::string familyTable(const FormulaResults& formula) {
  HtmlTable table({"inputs", "number", "gradient: peak of asked [eps]", "Hessian: peak of asked [eps]",
                   "tangential Hessian: peak of asked [eps]", "rotational gradient: peak of asked [eps]",
                   "error / claimed bound"});
  for (const FamilyLine& line : familyLinesOf(formula)) {
    const std::string description = descriptionOf(line.family);
    const std::string note =
        description.empty() ? "" : "<br>" + element("span", escaped(description), "class=\"soft\"");
    table.add({escaped(line.family) + note, std::to_string(line.inputs), againstPromise(line, Quantity::kGradient),
               againstPromise(line, Quantity::kHessian), againstPromise(line, Quantity::kTangentialHessian),
               againstPromise(line, Quantity::kRotationalGradient), figureText(line.worst_over_bound)});
  }
  return table.html();
}

/// Peak errors in eps of every formula for polygons, side by side.
std::string comparisonTable(const AccuracyReport& report) {
  std::vector<std::string> headings = {"inputs"};
  std::vector<std::vector<FamilyLine>> lines;
  for (const FormulaResults& formula : report.formulas) {
    if (!formula.is_flatland) {
      headings.push_back(formula.name);
      lines.push_back(familyLinesOf(formula));
    }
  }
  HtmlTable table(headings);
  for (const InputFamily& family : inputFamilies()) {
    for (const Quantity quantity : {Quantity::kGradient, Quantity::kHessian, Quantity::kTangentialHessian}) {
      std::vector<std::string> cells = {
          escaped(std::string(family.name) + ", " + quantityText(report.formulas.front(), quantity))};
      for (const std::vector<FamilyLine>& of_formula : lines) {
        const auto line = std::find_if(of_formula.begin(), of_formula.end(),
                                       [&](const FamilyLine& l) { return l.family == family.name; });
        const bool is_known = line != of_formula.end() && line->figures.contains(quantity);
        cells.push_back(is_known ? epsilonText(line->figures.at(quantity).verdict->peak) : "-");
      }
      table.add(cells);
    }
  }
  return table.html();
}

/// The check's name, for closed forms with the catalogue numbers that the formula was compared with.
std::string titleOf(const CheckExplanation& check, const FormulaResults& formula) {
  const std::string_view prefix = "closed form ";
  std::vector<std::string> numbers;
  std::size_t without_number = 0;
  for (const Verdict& v : formula.verdicts) {
    if (!v.check.starts_with(prefix)) {
      continue;
    }
    const std::string name = v.check.substr(prefix.size());
    if (name == v.family) {
      ++without_number;
    } else if (std::find(numbers.begin(), numbers.end(), name) == numbers.end()) {
      numbers.push_back(name);
    }
  }
  if (check.check != "closed form" || numbers.empty()) {
    return escaped(check.check);
  }
  std::string list;
  for (const std::string& number : numbers) {
    list += element("span", escaped(number), "class=\"whole\"") + ", ";
  }
  return escaped(check.check) + "<br>" +
         element("span",
                 std::to_string(numbers.size()) + " numbers of Howell's catalogue: " + list + "and " +
                     std::to_string(without_number) + " configurations without a number known to us",
                 "class=\"soft\"");
}

/// The peak of one check over all families of inputs, of one quantity or of all.
std::string peakOf(const FormulaResults& formula, const CheckExplanation& check, std::optional<Quantity> quantity) {
  std::optional<double> peak;
  for (const Verdict& v : formula.verdicts) {
    if (explanationOf(v.check).check == check.check && (!quantity || v.quantity == *quantity)) {
      raiseTo(peak, v.peak);
    }
  }
  return check.kind == CheckKind::kBounds ? figureText(peak) + (peak ? " of bound" : "") : epsilonText(peak);
}

/// Every oracle and invariant against every formula for polygons, over all families.
std::string oracleTable(const AccuracyReport& report) {
  const FormulaResults& promised = report.formulas.front();
  std::vector<std::string> headings = {
      "check",         "values compared",          "form factor [eps]",         "gradient [eps]",
      "Hessian [eps]", "tangential Hessian [eps]", "rotational gradient [eps]", "verdict"};
  std::vector<const FormulaResults*> comparisons;
  for (const FormulaResults& formula : report.formulas) {
    if (!formula.is_promised) {
      headings.push_back(formula.name + " [eps]");
      comparisons.push_back(&formula);
    }
  }
  HtmlTable table(headings);
  for (const CheckExplanation& check : checkLegend()) {
    std::size_t compared = 0;
    std::size_t verdicts = 0;
    std::size_t failed = 0;
    for (const Verdict& v : promised.verdicts) {
      if (explanationOf(v.check).check == check.check) {
        compared += v.inputs;
        ++verdicts;
        failed += v.passed ? 0 : 1;
      }
    }
    if (verdicts == 0) {
      continue;
    }
    std::vector<std::string> cells = {titleOf(check, promised), countText(compared)};
    for (const Quantity quantity : kQuantities) {
      cells.push_back(peakOf(promised, check, quantity));
    }
    cells.push_back(failed == 0
                        ? badge("holds", "right")
                        : badge("WRONG: " + std::to_string(failed) + " of " + std::to_string(verdicts), "wrong"));
    for (const FormulaResults* comparison : comparisons) {
      cells.push_back(peakOf(*comparison, check, std::nullopt));
    }
    table.add(cells);
  }
  return table.html();
}

std::string worstInput(const Verdict& verdict) {
  if (verdict.worst_input.empty()) {
    return "-";
  }
  const std::string command = "echo '" + verdict.worst_input + "' | ./run evaluate -";
  return element("details", element("summary", "input") + element("pre", escaped(command)));
}

std::string verdictTable(const FormulaResults& formula) {
  HtmlTable table(
      {"check", "inputs", "quantity", "number", "peak [eps]", "RMS [eps]", "allowed [eps]", "verdict", "worst input"});
  const auto add = [&](const Verdict& v, const std::string& allowed, const std::string& verdict) {
    const bool is_ratio = explanationOf(v.check).kind == CheckKind::kBounds;
    const auto text = [&](double figure) { return is_ratio ? figureText(figure) + " of bound" : epsilonText(figure); };
    const bool is_named_twice = v.check == "closed form " + v.family;
    table.add({escaped(is_named_twice ? "closed form" : v.check), escaped(v.family), quantityText(formula, v.quantity),
               std::to_string(v.inputs), text(v.peak), text(v.rms), is_ratio ? "1 of bound" : allowed, verdict,
               worstInput(v)});
  };
  for (const Verdict& v : formula.verdicts) {
    add(v, epsilonText(v.tolerance),
        v.passed ? badge("ok", formula.is_promised ? "right" : "none")
                 : badge(formula.is_promised ? "WRONG" : "not met", formula.is_promised ? "wrong" : "none"));
  }
  for (const Verdict& v : formula.unjudged) {
    add(v, "bound", badge("measured", "none"));
  }
  return table.html();
}

}  // namespace

std::string checksSection(const AccuracyReport& report) {
  std::string html = element("h2", "Checks", "id=\"checks\"") + '\n';
  for (const FormulaResults& formula : report.formulas) {
    if (formula.is_promised) {
      html += element("h3", escaped(formula.name) + ", by inputs") + '\n';
      html += element("p", escaped(formula.description) +
                               " Peaks against 200 digits; <b>bound</b>: no figure is promised "
                               "there, the reported bound must hold.") +
              '\n';
      html += familyTable(formula);
    }
  }
  html += element("h3", escaped(report.formulas.front().name) + ", by check") + '\n';
  html +=
      element("p",
              "Peak errors over all families that the check was run on, in eps; on the right the worst quantity of the "
              "formulas that promise nothing. A dash: not checked, or the check does not know the quantity. Errors "
              "against differences in double precision and against quadrature include those of the difference.") +
      '\n';
  html += oracleTable(report);
  html += element("h3", "Formulas side by side") + '\n';
  html += element("p",
                  "Peak errors in eps against 200 digits on the same inputs. A dash: "
                  "the formula knows no horizon and cannot take the inputs. 4.5e15 eps is an error as large as the "
                  "value.") +
          '\n';
  html += comparisonTable(report);
  html += element("h3", "Every check") + '\n';
  html += element("p",
                  "For each formula: check x family of inputs x quantity. The worst input is a command to paste into a "
                  "shell in the project's folder. Checks by differences or quadrature in double precision may exceed "
                  "what is allowed "
                  "by as much as their own error estimate.") +
          '\n';
  for (const FormulaResults& formula : report.formulas) {
    const std::size_t failed = failures(formula.verdicts).size();
    const std::string outcome =
        failed == 0 ? "all passed"
                    : std::to_string(failed) + (formula.is_promised ? " FAILED" : " not met, none promised");
    html +=
        element("details", element("summary", escaped(formula.name + ": " + std::to_string(formula.verdicts.size()) +
                                                      " checks, " + outcome)) +
                               element("p", escaped(formula.description)) + verdictTable(formula)) +
        '\n';
  }
  return html;
}

}  // namespace irradiff
