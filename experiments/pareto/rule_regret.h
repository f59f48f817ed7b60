#pragma once

#include "experiments/pareto/family_inputs.h"
#include "experiments/pareto/regret.h"

#include <string>
#include <vector>

namespace irradiff {

/// The chooser of evaluatePolygon on the inputs of a family, at one tolerance.
struct RuleRegret {
  std::string family;
  double tolerance = 0.0;
  std::size_t inputs = 0;
  std::size_t guaranteed = 0;  ///< of them those where some rule's bounds meet the tolerance: they count
  std::size_t missed = 0;      ///< of those, the ones where the chooser gives up
  std::size_t broken = 0;      ///< of all inputs those where the result says that it meets the tolerance, and does not
  std::size_t fell_back = 0;   ///< of those, the ones where it came to the rule without a tolerance
  Regret in_set;               ///< beside the rules that it chooses from
  Regret of_all;               ///< beside these and all formulas, of which none has bounds, where they apply
  double without_tolerance = 0.0;  ///< nanoseconds of evaluatePolygon without a tolerance, mean over those that count
};

/// For each of kChoiceTolerances. Whether a rule meets a tolerance in hindsight is judged by its errors, not by its
/// bounds. Rules take turns over `rounds` rounds on this thread.
std::vector<RuleRegret> regretsOf(const FamilyInputs& inputs, std::size_t rounds);

}  // namespace irradiff
