#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures the rays of 4096 samples of one receiver, faces prepared anew each time, and prints it as text: a thread's
/// rays a second on data/scenes/figure5.json, and against the number of polygons for both searches of RayCaster, as
/// median (smallest .. largest) over rounds. Times of the clock on the wall: nothing else should run.
void printRaySection(std::ostream& out);

}  // namespace irradiff
