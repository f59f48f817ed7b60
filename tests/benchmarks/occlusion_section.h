#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures what occlusion costs and prints it as text:
///   - visibility and evaluation on data/scenes/figure5.json by filtered predicates and by exact visibility (CGAL), and
///     their ratio within a round, as median (smallest .. largest) over rounds;
///   - the time of an evaluation against the number of polygons, 4 to 256, of scenes whose polygons lie beside each
///   other
///     in view and of scenes in which they overlap, with the growth from line to line as the exponent of n;
///   - the wall time of the analytic map of figure 5, 256 x 256 receivers on two threads.
/// Times of the clock on the wall: nothing else should run.
void printOcclusionSection(std::ostream& out);

}  // namespace irradiff
