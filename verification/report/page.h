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

/// A section that others add to the page, made with HtmlTable and element().
struct FurtherSection {
  std::string id;  ///< of its heading, which the page's navigation links
  std::string title;
  std::string html;
};

/// What stands on the page besides the report's own.
struct FurtherContent {
  std::vector<FurtherSection> sections;
  std::vector<FurtherPage> pages;
};

/// index.html: one document without scripts or anything from the network. `plots` holds two for each sweep, gradient
/// and Hessian, in the order of the sweeps.
std::string reportPage(const AccuracyReport& report, const RunRecord& record, const std::vector<SweepPlot>& plots,
                       const FurtherContent& further);

}  // namespace irradiff
