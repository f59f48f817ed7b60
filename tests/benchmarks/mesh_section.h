#pragma once

#include <iosfwd>

namespace irradiff {

/// Measures gradient and Hessian from the mesh over the samples of one 64 x 64 record on one thread, with radiance
/// different at every sample and with a few walls, and prints as text, as median (smallest .. largest) over rounds:
///   - the time with each set of vector instructions, and that of whole estimates, open and closed;
///   - that of the appendix form with acos, once an edge with a jump and triangle by triangle as published;
///   - the ratio of each to the first within a round, and how far each is from the sum over triangles with the kernel
///   in
///     angles.
/// Times of the clock on the wall: nothing else should run.
void printMeshSection(std::ostream& out);

}  // namespace irradiff
