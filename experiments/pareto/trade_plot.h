#pragma once

#include "experiments/pareto/pareto.h"

#include <string>

namespace irradiff {

/// One SVG: a panel for each family and one each for gradient and Hessian of the estimators, error against time, with
/// the Pareto front drawn. Requires gnuplot.
std::string tradePlot(const Pareto& pareto);

}  // namespace irradiff
