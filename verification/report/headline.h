#pragma once

#include "verification/report/accuracy_report.h"

#include <array>
#include <map>
#include <optional>
#include <string>

namespace irradiff {

/// What the summary says of one quantity of one formula.
struct Headline {
  Quantity quantity = Quantity::kFormFactor;
  std::size_t checks = 0;
  std::size_t failed = 0;
  std::size_t comparisons = 0;  ///< values compared, over all checks
  /// Worst relative errors against values of oracles; nothing where none was judged.
  std::optional<double> well_conditioned_peak;
  std::optional<double> extreme_peak;      ///< over all other families with a promise
  std::optional<double> worst_over_bound;  ///< error over claimed bound, over all families
};

/// Makes `worst` the larger of both; a NaN is the worst there is.
void raiseTo(std::optional<double>& worst, double value);

/// One for each quantity.
std::vector<Headline> headlinesOf(const FormulaResults& formula);

/// What is promised of one quantity and what was found.
struct FamilyFigure {
  double promise = 0.0;  ///< 0: the claimed bound alone
  std::optional<Verdict> verdict;
};

/// What is promised of one family and what was found, for a table of a row for each family.
struct FamilyLine {
  std::string family;
  std::size_t inputs = 0;
  /// Of each derivative against multiprecision; not judged where nothing is promised.
  std::map<Quantity, FamilyFigure> figures;
  std::optional<double> worst_over_bound;
};

/// The quantities that a FamilyLine has figures of.
inline constexpr std::array<Quantity, 4> kDerivatives = {Quantity::kGradient, Quantity::kHessian,
                                                         Quantity::kTangentialHessian, Quantity::kRotationalGradient};

/// The input families, in their order, and then the sweeps. Families of which there is no verdict are left out.
std::vector<FamilyLine> familyLinesOf(const FormulaResults& formula);

/// What is asked of well-conditioned inputs, and of all other promised families.
inline constexpr double kWellConditionedPromise = 2e-14;
inline constexpr double kExtremePromise = 1e-13;

}  // namespace irradiff
