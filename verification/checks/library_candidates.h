#pragma once

#include "verification/checks/candidate.h"

#include <vector>

namespace irradiff {

/// What `irradiff evaluate` uses: scaling, compensated geometry, boundary form or area rule, with its bounds. Signed by
/// the order of the vertices.
Candidate productionCandidate();
/// The boundary form alone, in double without compensation: what a renderer would write from
/// docs/derivations/radiance_boundary.md.
Candidate plainBoundaryCandidate();
/// The appendix form of the 2012 paper, its angle by acos as a renderer would write it. Knows no horizon.
Candidate appendixArccosCandidate();
/// The appendix form with the angle by atan2. Knows no horizon.
Candidate appendixArctangentCandidate();

}  // namespace irradiff
