#pragma once

#include "verification/checks/verdict.h"

#include <cstdint>
#include <vector>

namespace irradiff {

/// The candidate's gradient against differences of its own form factor, its Hessian and tangential Hessian
/// against differences of its own gradient, and its rotational gradient against differences of its own form factor over
/// the normal, in double with Ridders extrapolation and the extrapolation's own error estimate. Catches a derivative
/// that does not belong to the function; needs no reference.
std::vector<Verdict> checkSelfConsistency(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                          double tolerance);

}  // namespace irradiff
