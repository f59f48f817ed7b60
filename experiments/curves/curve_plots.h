#pragma once

#include "experiments/curves/metric_study.h"

#include <string>

namespace irradiff {

/// One SVG: RMS error against records, all metrics, with the band over the fields; beside it against rays where records
/// take any. Requires gnuplot.
std::string curvePlot(const SceneStudy& scene);

/// One SVG: 5, 25, 50, 75 and 95 % of the receivers' ratios for each metric: radius over the oracle's, true error over
/// what the oracle's threshold allows, true error over what the metric promises. Requires gnuplot.
std::string ratioPlot(const SceneStudy& scene);

}  // namespace irradiff
