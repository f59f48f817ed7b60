#include "verification/report/write_report.h"

#include "verification/report/accuracy_markdown.h"
#include "verification/report/page.h"
#include "verification/report/report_tables.h"
#include "verification/report/sweep_plots.h"

namespace irradiff {

void writeReport(const AccuracyReport& report, const RunRecord& record, const ResultFolder& folder,
                 const FurtherContent& further) {
  std::vector<SweepPlot> plots;
  for (const ErrorSweep& sweep : report.sweeps) {
    for (const Quantity quantity : {Quantity::kGradient, Quantity::kHessian}) {
      plots.push_back(plotSweep(sweep, quantity));
      folder.write("plots/" + plots.back().file, plots.back().svg);
    }
  }
  folder.write("index.html", reportPage(report, record, plots, further));
  folder.write("verdicts.csv", verdictsCsv(report));
  folder.write("verdicts.json", verdictsJson(report));
  folder.write("sweeps.csv", sweepsCsv(report));
  folder.write("sweeps.json", sweepsJson(report));
  folder.write("errata.csv", errataCsv(report));
  folder.write("errata.json", errataJson(report));
  folder.write("gap_filling.csv", gapFillingCsv(report));
  folder.write("gap_filling.json", gapFillingJson(report));
  folder.write("bound_tightness.csv", boundTightnessCsv(report));
  folder.write("bound_tightness.json", boundTightnessJson(report));
  folder.write("accuracy.md", accuracyMarkdown(report));
  folder.write("run.json", runJson(report, record));
}

}  // namespace irradiff
