#pragma once

#include "experiments/pareto/spread.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// One way to evaluate the inputs of a family, measured: for each input whether its error meets a tolerance, and its
/// times in each round.
struct MeasuredRule {
  std::vector<bool> meets;
  std::vector<std::vector<double>> nanoseconds;  ///< [input][round]
};

/// What a chooser costs beside the best choices in hindsight.
struct Regret {
  std::size_t inputs = 0;  ///< that count
  Spread regret;           ///< chooser's time over that of the best choices, summed over the inputs, each round
  double chosen = 0.0;     ///< nanoseconds of the chooser, mean over the inputs, median over the rounds
  double best = 0.0;       ///< likewise of the best choices
  std::vector<std::size_t> best_rules;  ///< for each input that counts, an index of the rules
};

/// The best choice for an input is the rule with the least median time of those that meet the tolerance there; an input
/// counts if `counts` says so and some rule meets. Both times of a ratio are of the same round. Requires as many inputs
/// and rounds everywhere, at least one round. Without inputs that count the times are 0.
Regret regretOf(const std::vector<std::vector<double>>& chooser_nanoseconds, const std::vector<MeasuredRule>& rules,
                const std::vector<bool>& counts);

}  // namespace irradiff
