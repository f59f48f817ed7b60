#pragma once

#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/ray_query.h"

#include <cstddef>
#include <memory>

namespace irradiff {

/// An estimate with the number of rays that it took.
struct DiscontinuityEstimate {
  IrradianceEstimate estimate;
  std::size_t rays = 0;
};

/// The fewest rays that estimateFromDiscontinuities() works with.
inline constexpr std::size_t kFewestDiscontinuityRays = 16;

// Irradiance and its derivatives from the radiance boundary, which rays are spent on locating: a lattice of rays over
// the hemisphere, refined where radiance jumps between neighbours; then more rays between two that see different
// regions, for the outermost jumps of each straight edge most; edges fitted through the jumps at the depth of the
// nearer surface, arcs between the places where edges cross in view, apparent vertices with their motion. Exact up to
// the width of the jumps where no feature is smaller than a cell. What radiance varies beside its jumps goes over a
// mesh of the lattice's nodes as in `triangulated-closed`.
// docs/derivations/discontinuity_estimator.md.
//
// Takes at most `budget` rays; the lattice is turned by `rotation` radians. Vectors are in the frame of the query.
// Throws std::invalid_argument naming the budget if it is below kFewestDiscontinuityRays, the rotation if it is not
// finite, or the direction and the value of a ray whose inverse distance or radiance is not finite or below 0;
// std::overflow_error if a result is beyond the range of double: every number that is returned is finite.
DiscontinuityEstimate estimateFromDiscontinuities(const RayQuery& query, std::size_t budget, double rotation = 0.0);

// The same from given samples: jumps are between neighbours in the mesh over them, and no narrower.
// Irradiance and rotational gradient are sums over strata. Samples without a mesh give no derivatives of position.
// Throws as Strata does.
std::unique_ptr<Estimator> makeDiscontinuity(Stratification stratification, GridShape shape);

}  // namespace irradiff
