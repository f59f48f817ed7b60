#pragma once

#include "derivatives/flatland/half_circle.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// From `start` up to the next piece the source is front-most.
struct FrontPiece {
  FlatlandDirection start;
  std::size_t source;  ///< or kNobody
};

/// The lower envelope of distances: what is front-most in the directions of the half circle, counterclockwise from the
/// horizon's start; end-on sources hide nothing. O(n log n) by divide and conquer where few sources cross. Throws
/// InvalidScene, naming both, where two segments of different radiance that lie on one line are both seen.
std::vector<FrontPiece> lowerEnvelope(const HalfCircle& half_circle);

}  // namespace irradiff
