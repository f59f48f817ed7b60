#pragma once

#include "experiments/figures/convergence.h"
#include "experiments/figures/error_split.h"

#include <span>
#include <string>

namespace irradiff {

/// An SVG plot of the curves of one quantity: the median relative error against the rays of a receiver, with the range
/// of 90 % of the seeds. Throws as runGnuplot.
std::string convergencePlot(std::span<const ConvergenceCurve> curves, Compared compared);

/// An SVG plot with a panel for each estimator that has this quantity: where its error comes from, against the rays of
/// a receiver. Throws as runGnuplot.
std::string errorSplitPlot(std::span<const ErrorSplitCurve> curves, Compared compared);

}  // namespace irradiff
