#pragma once

#include "verification/report/accuracy_report.h"
#include "verification/report/run_record.h"
#include "verification/report/sweep_plots.h"

#include <string>
#include <vector>

namespace irradiff {

/// index.html: one document without scripts or anything from the network. `plots` holds two for each sweep, gradient
/// and Hessian, in the order of the sweeps.
std::string reportPage(const AccuracyReport& report, const RunRecord& record, const std::vector<SweepPlot>& plots);

}  // namespace irradiff
