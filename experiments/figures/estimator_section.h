#pragma once

#include "experiments/figures/estimator_comparison.h"
#include "experiments/figures/quality_figure.h"
#include "verification/report/page.h"

#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// What the comparison shows, as sentences made of its numbers alone: for each scene and quantity who is best and who
/// next; who gives 0 for constant radiance, and whether all who claim it do.
std::vector<std::string> comparisonSentences(const EstimatorComparison& comparison);

/// The section of the report's page: those sentences, a table for each scene with errors, what constant radiance gives
/// and the orders of the curves, and the curves' plots. Throws as runGnuplot.
FurtherSection estimatorSection(const EstimatorComparison& comparison, std::span<const QualityFigure::Curves> curves);

}  // namespace irradiff
