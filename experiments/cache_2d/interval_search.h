#pragma once

#include "derivatives/error_metric/error_ellipse.h"

#include <vector>

namespace irradiff {

/// The error |E(x + d) - E'(x + d)| of a record's extrapolation, on one side of the record: between two places it is
/// linear; two places at one distance are a jump.
struct SideError {
  std::vector<double> distances;  ///< to the record, ascending; m
  std::vector<double> errors;     ///< there; W/m
};

// The half-length R at which the integral of the error over the interval from x - R to x + R, or with kMean that over
// 2 R, first exceeds `threshold`: Eq. (4) of [Schwarzhaupt et al. 2012] in flatland. Up to the first place on a side
// the error grows with the square of the distance; beyond the last it is 0, as no receiver is there. m; infinite if it
// never does. Requires a threshold >= 0.
double intervalOfError(const SideError& before, const SideError& after, double threshold, ErrorMeasure measure);

/// The integral of the error over the interval from x - R to x + R, as above. W.
double integratedError(const SideError& before, const SideError& after, double half_length);

}  // namespace irradiff
