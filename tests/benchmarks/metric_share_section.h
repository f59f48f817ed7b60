#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures at records of the Cornell box, 4096 rays each, on one thread, and prints as text, as median (smallest ..
/// largest) over rounds: the time of a gather that has the direct light at every hit exactly; that of a record's
/// gradients; of its errors by reprojection, 16 directions and 10 distances; of the largest ellipse that they allow;
/// and each over that of the gather. Times of the clock on the wall: nothing else should run.
void printMetricShareSection(std::ostream& out);

}  // namespace irradiff
