#pragma once

#include "verification/checks/verdict.h"

#include <cstdint>
#include <vector>

namespace irradiff {

/// The candidate's form factor against the closed forms of verification/closed_forms: one verdict for each
/// configuration of the catalogue, over `inputs` seeded parameter sets each. Catches a wrong F.
std::vector<Verdict> checkClosedForms(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                      double tolerance);

/// Likewise against the closed forms from a finite area, which are means of F over that area: by adaptive quadrature of
/// the candidate, whose own error estimate is allowed besides. The worst input has its receiver in the area's middle.
std::vector<Verdict> checkClosedFormsBetweenAreas(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                                  double tolerance);

}  // namespace irradiff
