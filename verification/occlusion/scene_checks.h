#pragma once

#include "verification/checks/verdict.h"
#include "verification/occlusion/scene_candidate.h"
#include "verification/occlusion/scene_families.h"

#include <cstdint>

namespace irradiff {

/// What a suite of checks does. The defaults suit a double-precision evaluator.
struct OcclusionOptions {
  std::uint64_t seed = 1;
  std::size_t scenes = 10;      ///< for each family and check
  double tolerance = 1e-11;     ///< relative error allowed
  bool includes_events = true;  ///< scenes whose receiver is near a visibility event
};

/// Against differences of irradiance at 200 digits, in which everything that is hidden is cut away anew at each place
/// (CutScene): catches wrong visibility, wrong formulas, and motion that was forgotten. One verdict "visible regions"
/// for each quantity that the candidate has. Errors in the max norm, of the derivatives relative to that of the
/// expected value, of irradiance relative to pi times the largest radiance. Where the candidate claims bounds, one
/// verdict "claimed bound" more for each quantity.
std::vector<Verdict> checkVisibleRegions(const SceneCandidate& candidate, const SceneFamily& family,
                                         const OcclusionOptions& options);

/// All checks, on all families.
std::vector<Verdict> checkOcclusion(const SceneCandidate& candidate, const OcclusionOptions& options);

}  // namespace irradiff
