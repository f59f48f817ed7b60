#pragma once

#include "experiments/figures/quality_figure.h"
#include "verification/report/accuracy_report.h"
#include "verification/report/page.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <cstdint>

namespace irradiff {

/// What the figures of a report are made with.
struct ReportFigureOptions {
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// Makes Figures 5 and 6, the comparison of estimators, the stability atlas, the trade of speed against accuracy and
/// the study of error metrics, and writes them into the report's folder: figure5/, figure5_sampled/, figure6/,
/// estimators.csv and estimators.json, atlas/, pareto/, metrics/. Returns the sections and the pages that index.html
/// has of them. Throws as readFigureScene, readRecordScene and runGnuplot.
FurtherContent writeReportFigures(const ReportFigureOptions& options, const RunRecord& record,
                                  const ResultFolder& folder, const QualityProgress& progress);

}  // namespace irradiff
