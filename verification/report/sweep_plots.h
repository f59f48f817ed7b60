#pragma once

#include "verification/report/error_sweeps.h"

#include <string>
#include <vector>

namespace irradiff {

struct SweepPlot {
  std::string file;  ///< name without folder, "edge_over_distance_gradient.svg"
  std::string title;
  std::string svg;
};

/// Error against size for one quantity: peak and median of each formula, the promised formula's claimed bound, the
/// promise. Same sweep, same bytes. Requires gnuplot.
SweepPlot plotSweep(const ErrorSweep& sweep, Quantity quantity);

}  // namespace irradiff
