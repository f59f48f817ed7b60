#pragma once

#include "verification/occlusion/scene_checks.h"

namespace irradiff {

/// Laws that need no reference. Where the candidate claims bounds, two results may differ by the sum of theirs; else by
/// the tolerance, relative to the larger of both. One verdict for each law and quantity.
///
/// - "energy": irradiance is at most pi times the largest radiance.
/// - "quarter turn": with the coordinates permuted, (x, y, z) -> (y, z, x), the derivatives are permuted.
/// - "unit of length": lengths times a power of two change derivatives by its powers, and no digit.
/// - "unseen polygon": a black polygon that is below the horizon, behind another or in an empty direction changes
///   no bit.
/// - "split polygon": a triangle and its two halves give the same. On triangles with vertices on a grid, whose edges'
///   midpoints are exact.
std::vector<Verdict> checkSceneInvariants(const SceneCandidate& candidate, const SceneFamily& family,
                                          const OcclusionOptions& options);

/// A closed room of one radiance with blocks of the same inside: irradiance is pi times the radiance, and nothing
/// changes with the receiver. One verdict for each quantity.
std::vector<Verdict> checkConstantRooms(const SceneCandidate& candidate, const OcclusionOptions& options);

}  // namespace irradiff
