#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures gradient and Hessian from the mesh over the samples of one 64 x 64 record on one thread, and prints as
/// text:
///   - the time of a whole estimate, open and closed, with radiance different at every sample and with a few walls;
///   - that of the derivatives alone with each set of vector instructions;
///   - that of the appendix form with acos, triangle by triangle as published and once an edge, with the ratio to ours
///     within a round, as median (smallest .. largest) over rounds;
///   - how far each is from the same sum triangle by triangle with the kernel in angles.
/// Times of the clock on the wall: nothing else should run.
void printMeshSection(std::ostream& out);

}  // namespace irradiff
