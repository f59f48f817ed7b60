#pragma once

#include "verification/report/accuracy_report.h"
#include "verification/report/run_record.h"
#include "verification/report/sweep_plots.h"

#include <string>
#include <vector>

namespace irradiff {

// The sections of the report's page, as HTML.

/// Verdict, headline figures and failures; how to read them comes after.
std::string summarySection(const AccuracyReport& report, const RunRecord& record);
/// What the figures mean, and what each check can and cannot see.
std::string legendSection();
/// Peak errors by family and formula, then every check with its worst input.
std::string checksSection(const AccuracyReport& report);
std::string plotsSection(const AccuracyReport& report, const std::vector<SweepPlot>& plots);
std::string errataSection(const AccuracyReport& report);
/// A histogram of the errors of the gap-filled Hessian over all scenes, a row and a histogram for each family.
std::string gapFillingSection(const AccuracyReport& report);
/// Reported bounds over actual errors: a table for each evaluator, a row for each family.
std::string tightnessSection(const AccuracyReport& report);
std::string referencesSection(const AccuracyReport& report);

/// A table whose cells name their column, so that a narrow screen can show a row as a card. Cells are HTML, headings
/// text.
class HtmlTable {
 public:
  explicit HtmlTable(std::vector<std::string> headings) : headings_(std::move(headings)) {}
  /// As many cells as headings. Throws std::invalid_argument.
  void add(const std::vector<std::string>& cells);
  std::string html() const;

 private:
  std::vector<std::string> headings_;
  std::string rows_;
};

/// A verdict in colour: `kind` is "right", "wrong" or "none".
std::string badge(const std::string& text, const std::string& kind);

}  // namespace irradiff
