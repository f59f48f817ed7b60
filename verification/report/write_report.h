#pragma once

#include "verification/report/accuracy_report.h"
#include "verification/report/page.h"
#include "verification/report/result_folder.h"
#include "verification/report/run_record.h"

#include <vector>

namespace irradiff {

/// Writes index.html, verdicts, sweeps, errata and gap_filling as .csv and .json, plots/*.svg, accuracy.md and run.json
/// into the folder; the caller commits it, and writes the further pages, which index.html links, and the files that
/// further sections name. Requires gnuplot.
void writeReport(const AccuracyReport& report, const RunRecord& record, const ResultFolder& folder,
                 const FurtherContent& further = {});

}  // namespace irradiff
