#pragma once

#include "verification/report/accuracy_report.h"
#include "verification/report/run_record.h"
#include "verification/report/sweep_plots.h"

#include <string>
#include <vector>

namespace irradiff {

/// A page beside the report's own.
struct FurtherPage {
  std::string path;  ///< from the report's folder, "figure5/index.html"
  std::string title;
  std::string summary;  ///< a sentence: what is there
};

/// index.html: one document without scripts or anything from the network. `plots` holds two for each sweep, gradient
/// and Hessian, in the order of the sweeps.
std::string reportPage(const AccuracyReport& report, const RunRecord& record, const std::vector<SweepPlot>& plots,
                       const std::vector<FurtherPage>& further_pages);

}  // namespace irradiff
