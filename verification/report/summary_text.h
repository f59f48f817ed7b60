#pragma once

#include "verification/report/accuracy_report.h"
#include "verification/report/headline.h"

#include <string>
#include <vector>

namespace irradiff {

/// What a reader should take away, a sentence each: whether the promises hold, the worst figures, what was compared.
std::vector<std::string> summarySentences(const AccuracyReport& report);
std::string plainText(const std::vector<std::string>& sentences);

/// "form factor", "gradient", "Hessian"; in flatland "irradiance".
std::string quantityText(const FormulaResults& formula, Quantity quantity);

/// "holds", "WRONG: 3 of 40 checks" or, for a formula without promises, "no promise: 12 of 40 checks".
std::string verdictText(const FormulaResults& formula, const Headline& headline);

/// The range of the printed formula's residuals.
std::string printedText(const ErratumMeasurement& measurement);

}  // namespace irradiff
