#pragma once

#include "experiments/figures/quality_figure.h"
#include "experiments/pareto/estimator_trade.h"
#include "experiments/pareto/polygon_trade.h"
#include "experiments/pareto/rule_regret.h"
#include "verification/report/accuracy_report.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {

/// What speed against accuracy is measured with.
struct ParetoPlan {
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  std::vector<std::string> families;  ///< names of input families; all if empty
  std::size_t inputs = 0;             ///< of each family
  std::size_t rounds = 0;
  EstimatorPlan estimators;
};

/// Quick takes seconds, standard half a minute, full minutes.
ParetoPlan paretoPlan(Effort effort, std::uint64_t seed);

/// Speed against accuracy of everything that gives derivatives.
struct Pareto {
  ParetoPlan plan;
  std::vector<FamilyTrade> families;
  std::vector<RuleRegret> regrets;  ///< a tolerance after the other for each family
  std::vector<EstimatorTrade> estimators;
};

/// Measures on this thread. `scene` is what estimators are measured on. Throws std::invalid_argument for a family that
/// does not exist.
Pareto measurePareto(const ParetoPlan& plan, const FigureScene& scene, const QualityProgress& progress = {});

/// Writes pareto.svg, trade (times and errors), errors (no times: the same for the same plan), regret and estimators as
/// .csv and .json, index.html and run.json into the folder, which the caller commits. `subfolder` is where they go in
/// it, empty for the folder itself. Requires gnuplot.
void writePareto(const Pareto& pareto, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder = {});

}  // namespace irradiff
