#pragma once

#include "verification/checks/candidate.h"
#include "verification/checks/flatland_suite.h"
#include "verification/checks/verdict.h"
#include "verification/report/bound_tightness.h"
#include "verification/report/errata.h"
#include "verification/report/error_sweeps.h"
#include "verification/report/gap_filling_losses.h"
#include "verification/report/reference_summary.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// How much is drawn: quick takes under a minute, standard under five on two cores.
enum class Effort { kQuick, kStandard, kFull };

const char* nameOf(Effort effort);

/// Sizes that follow from the effort.
struct ReportSizes {
  std::size_t inputs;              ///< for each family and check
  std::size_t slow_oracle_inputs;  ///< for enclosures and 200-digit differences
  std::size_t sweep_samples;       ///< for each size of a sweep
  std::size_t errata_inputs;
  std::size_t gap_filling_scenes;  ///< for each family of scenes
};
ReportSizes sizesOf(Effort effort);

/// A formula that promises nothing here and stands in the report for comparison.
struct ComparisonFormula {
  Candidate candidate;
  std::string description;
  bool knows_horizon = false;
};

/// What a report is about.
struct ReportedFormulas {
  Candidate production;
  FlatlandCandidate flatland;
  std::vector<ComparisonFormula> comparisons;
  std::vector<BoundedEvaluator> bounded;  ///< whose bounds are measured
};

/// The library's own.
ReportedFormulas libraryFormulas();

struct ReportOptions {
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  unsigned threads = 1;                    ///< the results do not depend on it
  std::filesystem::path reference_folder;  ///< data/reference
  /// Called with the number of parts done and of all parts, never twice at a time. May be empty.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// All verdicts on one formula.
struct FormulaResults {
  std::string name;
  std::string description;
  bool is_promised = false;  ///< else a failed verdict is a difference to look at, no defect
  bool is_flatland = false;
  std::vector<Verdict> verdicts;
  /// Errors on families where the formula promises its claimed bound alone: shown, not judged.
  std::vector<Verdict> unjudged;
};

struct AccuracyReport {
  Effort effort = Effort::kStandard;
  std::uint64_t seed = 1;
  std::vector<FormulaResults> formulas;  ///< production, flatland, then the comparisons
  std::vector<ErrorSweep> sweeps;
  std::vector<Erratum> errata;
  std::vector<GapFillingLosses> gap_filling;
  std::vector<BoundTightness> tightness;
  std::vector<ReferenceSummary> references;
};

/// Failed verdicts on promised formulas.
std::vector<Verdict> brokenPromises(const AccuracyReport& report);

/// Errata whose measured residuals do not bear them out.
std::vector<Erratum> unconfirmedErrata(const AccuracyReport& report);

/// Bounds that some error exceeds.
std::vector<BoundTightness> brokenBounds(const AccuracyReport& report);

/// What a program that made the report ends with: 0, or 1 if a promise or a bound is broken or an erratum not borne
/// out.
int exitStatusOf(const AccuracyReport& report);

/// Runs all checks, sweeps, errata and what filling gaps loses. Throws InvalidReference if the reference data cannot be
/// read.
AccuracyReport makeReport(const ReportedFormulas& formulas, const ReportOptions& options);

}  // namespace irradiff
