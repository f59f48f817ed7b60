#pragma once

#include "derivatives/flatland/flatland_estimate.h"
#include "derivatives/flatland/flatland_samples.h"

#include <cstddef>

namespace irradiff {

/// A flatland estimate with the number of rays that it took.
struct FlatlandDiscontinuityEstimate {
  FlatlandEstimate estimate;
  std::size_t rays = 0;
};

/// The fewest rays that estimateFromFlatlandDiscontinuities() works with.
inline constexpr std::size_t kFewestFlatlandDiscontinuityRays = 4;

// Irradiance and its derivatives from the radiance boundary, which rays are spent on locating: half of them at equal
// angles, the others one by one in the middle of two neighbours with the largest product of the difference of their
// radiances and the angle between them, until the directions beside each jump are neighbouring numbers. Between two
// neighbours of different radiance there is a point of the scene at the nearer of their distances, or on the line
// through their hits if these are on one surface. Where radiance is constant but for its jumps, and nothing that
// radiates differently hides between two of the first rays, that is exact up to the angles that remain beside the
// jumps. Where it varies on surfaces the error is of second order in the angle between rays; that of the Hessian is of
// first order where one hides a part of another, since the jump at its end changes with the place behind it.
// docs/derivations/flatland.md, section 6.
//
// Takes at most `budget` rays. Vectors are in the frame of the query.
// Throws std::invalid_argument naming the budget if it is below kFewestFlatlandDiscontinuityRays, std::overflow_error
// if a number is beyond the range of double.
FlatlandDiscontinuityEstimate estimateFromFlatlandDiscontinuities(const FlatlandRayQuery& query, std::size_t budget);

/// The same from given samples alone, whose noise would swamp how fast radiance varies: the Hessian takes it as
/// constant behind the ends of what is in front. Irradiance and rotational gradient are sums over strata. A single
/// sample gives no derivatives of position.
FlatlandEstimate estimateDiscontinuity(const FlatlandSamples& samples);

}  // namespace irradiff
