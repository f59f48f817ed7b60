#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures, on one thread, what derivatives cost beside the rays that they are made of: 64 x 64 concentric jittered
/// samples at receivers all over data/scenes/figure5.json are cast by RayCaster, which prepares its faces anew for
/// each, and gradient and Hessian are made of the mesh over them. Prints both times for a receiver and their ratio, as
/// median (smallest .. largest) over rounds; a ratio is of two times in the same round. Making the rays' directions
/// counts as neither. Times of the clock on the wall: nothing else should run.
void printDerivativeShareSection(std::ostream& out);

}  // namespace irradiff
