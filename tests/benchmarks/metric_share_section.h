#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures at records of the Cornell box, 4096 rays each, on one thread, and prints as text: the time of a gather that
/// has the direct light at every hit exactly, and of one that reads it from a table; of each metric, the time of all
/// that it takes besides the gather (irradiance and gradients, Hessian or reprojection, region), and both shares. Times
/// of the clock on the wall: nothing else should run.
void printMetricShareSection(std::ostream& out);

}  // namespace irradiff
