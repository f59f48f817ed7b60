#include "verification/report/headline.h"

#include "verification/checks/input_families.h"
#include "verification/report/check_legend.h"

#include <algorithm>
#include <cmath>

namespace irradiff {
namespace {

bool isWellConditioned(const Verdict& verdict) {
  return verdict.family == "well-conditioned" || verdict.family == "flatland, generic";
}

FamilyLine familyLine(const FormulaResults& formula, const std::string& family) {
  FamilyLine line;
  line.family = family;
  for (const Verdict& verdict : formula.verdicts) {
    if (verdict.family != family) {
      continue;
    }
    if (verdict.check == "claimed bound") {
      raiseTo(line.worst_over_bound, verdict.peak);
      line.inputs = std::max(line.inputs, verdict.inputs);
    } else if (verdict.check == "multiprecision" && verdict.quantity != Quantity::kFormFactor) {
      line.figures[verdict.quantity] = {verdict.tolerance, verdict};
      line.inputs = std::max(line.inputs, verdict.inputs);
    }
  }
  for (const Verdict& verdict : formula.unjudged) {
    if (verdict.family == family) {
      line.figures[verdict.quantity] = {0.0, verdict};
    }
  }
  return line;
}

}  // namespace

void raiseTo(std::optional<double>& worst, double value) {
  if (!worst || std::isnan(value) || value > *worst) {
    worst = worst && std::isnan(*worst) ? worst : value;
  }
}

std::vector<Headline> headlinesOf(const FormulaResults& formula) {
  std::vector<Headline> headlines;
  for (const Quantity quantity : kQuantities) {
    Headline headline;
    headline.quantity = quantity;
    for (const Verdict& verdict : formula.verdicts) {
      if (verdict.quantity != quantity) {
        continue;
      }
      ++headline.checks;
      headline.failed += verdict.passed ? 0 : 1;
      headline.comparisons += verdict.inputs;
      switch (explanationOf(verdict.check).kind) {
        case CheckKind::kValues:
          raiseTo(isWellConditioned(verdict) ? headline.well_conditioned_peak : headline.extreme_peak, verdict.peak);
          break;
        case CheckKind::kBounds:
          raiseTo(headline.worst_over_bound, verdict.peak);
          break;
        case CheckKind::kConsistency:
          break;
      }
    }
    // The comparison formulas do not give every quantity.
    if (headline.checks > 0 || formula.is_promised) {
      headlines.push_back(headline);
    }
  }
  return headlines;
}

std::vector<FamilyLine> familyLinesOf(const FormulaResults& formula) {
  std::vector<std::string> families;
  for (const InputFamily& family : inputFamilies()) {
    families.emplace_back(family.name);
  }
  for (const Verdict& verdict : formula.verdicts) {
    const bool is_family = verdict.family.starts_with("sweep: ") || verdict.family.starts_with("flatland, ");
    const bool is_judged = verdict.check == "multiprecision" || verdict.check == "claimed bound";
    if (is_family && is_judged && std::find(families.begin(), families.end(), verdict.family) == families.end()) {
      families.push_back(verdict.family);
    }
  }
  std::vector<FamilyLine> lines;
  for (const std::string& family : families) {
    FamilyLine line = familyLine(formula, family);
    if (line.inputs > 0) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace irradiff
