#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures, on one thread, what derivatives cost beside the rays that they are made of: 64 x 64 concentric jittered
/// samples at receivers all over data/scenes/figure5.json are cast by RayCaster, which prepares its faces anew for
/// each, and gradient and Hessian are made of the mesh over them. Prints the times for a receiver and what the
/// derivatives' are of the rays', without and with that of making their directions, as median (smallest .. largest)
/// over rounds; a percentage is of two times in the same round. Times of the clock on the wall: nothing else should
/// run.
void printDerivativeShareSection(std::ostream& out);

}  // namespace irradiff
