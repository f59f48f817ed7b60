#include "experiments/pareto/trade_tables.h"

#include <array>

namespace irradiff {

namespace {

constexpr std::array<const char*, 4> kQuantityNames = {"form factor", "gradient", "hessian", "largest"};

}  // namespace

ResultTable tradeTable(const Pareto& pareto) {
  ResultTable table({"family", "method", "group", "inputs", "compared", "median_error", "percentile_99_error",
                     "max_error", "nanoseconds", "nanoseconds_low", "nanoseconds_high", "ratio", "ratio_low",
                     "ratio_high", "on_front"});
  for (const FamilyTrade& family : pareto.families) {
    for (const MethodTrade& method : family.methods) {
      if (method.compared == 0) continue;
      const ErrorStatistics& errors = method.errors[kLargestError];
      table.add({family.family, method.method, std::string(nameOf(method.group)), family.inputs, method.compared,
                 errors.median, errors.percentile99, errors.peak, method.nanoseconds.median, method.nanoseconds.low,
                 method.nanoseconds.high, method.ratio.median, method.ratio.low, method.ratio.high, method.on_front});
    }
  }
  return table;
}

ResultTable errorTable(const Pareto& pareto) {
  ResultTable table(
      {"family", "method", "quantity", "inputs", "compared", "median_error", "percentile_99_error", "max_error"});
  for (const FamilyTrade& family : pareto.families) {
    for (const MethodTrade& method : family.methods) {
      if (method.compared == 0) continue;
      for (std::size_t k = 0; k < kQuantityNames.size(); ++k) {
        const ErrorStatistics& errors = method.errors[k];
        table.add({family.family, method.method, std::string(kQuantityNames[k]), family.inputs, method.compared,
                   errors.median, errors.percentile99, errors.peak});
      }
    }
  }
  return table;
}

ResultTable regretTable(const Pareto& pareto) {
  ResultTable table({"family", "tolerance", "inputs", "guaranteed", "missed", "broken", "fell_back", "compared",
                     "regret", "regret_low", "regret_high", "chosen_nanoseconds", "best_nanoseconds", "regret_of_all",
                     "regret_of_all_low", "regret_of_all_high", "without_tolerance_nanoseconds"});
  for (const RuleRegret& row : pareto.regrets) {
    table.add({row.family, row.tolerance, row.inputs, row.guaranteed, row.missed, row.broken, row.fell_back,
               row.in_set.inputs, row.in_set.regret.median, row.in_set.regret.low, row.in_set.regret.high,
               row.in_set.chosen, row.in_set.best, row.of_all.regret.median, row.of_all.regret.low,
               row.of_all.regret.high, row.without_tolerance});
  }
  return table;
}

ResultTable estimatorTable(const Pareto& pareto) {
  ResultTable table({"estimator", "quantity", "rays", "receivers", "median_error", "percentile_99_error", "max_error",
                     "microseconds", "microseconds_low", "microseconds_high", "estimate_share", "on_front"});
  for (const EstimatorTrade& row : pareto.estimators) {
    table.add({row.estimator.label(), std::string(quantityOf(row.compared).name), row.rays, row.receivers,
               row.errors.median, row.errors.percentile99, row.errors.peak, row.microseconds.median,
               row.microseconds.low, row.microseconds.high, row.estimate_share.median, row.on_front});
  }
  return table;
}

}  // namespace irradiff
