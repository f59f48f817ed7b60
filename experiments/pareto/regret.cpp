#include "experiments/pareto/regret.h"

#include <optional>

namespace irradiff {

Regret regretOf(const std::vector<std::vector<double>>& chooser_nanoseconds, const std::vector<MeasuredRule>& rules,
                const std::vector<bool>& counts) {
  Regret result;
  if (chooser_nanoseconds.empty()) return result;
  const std::size_t rounds = chooser_nanoseconds.front().size();
  std::vector<double> chosen(rounds, 0.0);
  std::vector<double> best(rounds, 0.0);
  for (std::size_t input = 0; input < chooser_nanoseconds.size(); ++input) {
    std::optional<std::size_t> best_rule;
    double least = 0.0;
    for (std::size_t rule = 0; rule < rules.size(); ++rule) {
      if (!rules[rule].meets[input]) continue;
      const double time = spreadOf(rules[rule].nanoseconds[input]).median;
      if (!best_rule || time < least) {
        best_rule = rule;
        least = time;
      }
    }
    if (!counts[input] || !best_rule) continue;
    result.best_rules.push_back(*best_rule);
    for (std::size_t round = 0; round < rounds; ++round) {
      chosen[round] += chooser_nanoseconds[input][round];
      best[round] += rules[*best_rule].nanoseconds[input][round];
    }
  }
  result.inputs = result.best_rules.size();
  if (result.inputs == 0) return result;
  std::vector<double> ratios;
  for (std::size_t round = 0; round < rounds; ++round) ratios.push_back(chosen[round] / best[round]);
  result.regret = spreadOf(ratios);
  result.chosen = spreadOf(chosen).median / static_cast<double>(result.inputs);
  result.best = spreadOf(best).median / static_cast<double>(result.inputs);
  return result;
}

}  // namespace irradiff
