#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "tests/flatland/scene_draws.h"

#include <cstddef>
#include <functional>
#include <string>

namespace irradiff {

using SceneCandidate = std::function<SceneEvaluation<2>(const FlatlandScene&)>;

/// The library's evaluateScene.
SceneEvaluation<2> evaluateByLibrary(const FlatlandScene& scene);

/// How a candidate fared against E in 150 digits and its differences, the visibility found anew by rational arithmetic
/// at every point of the stencil. Largest of each over the scenes that it was judged by.
struct SceneVerdict {
  std::size_t judged = 0;
  std::size_t at_events = 0;   ///< not judged: the candidate says that there is no derivative
  std::size_t far = 0;         ///< judged at least kFarFromEvents from every visibility event
  double bound_share = 0.0;    ///< error over claimed bound
  double norm_wise_far = 0.0;  ///< error over the quantity's norm, far from events
  std::string worst_bound, worst_far;

  std::string text() const;
};

inline constexpr double kFarFromEvents = 1e-4;

SceneVerdict checkScenes(const SceneCandidate& candidate, const SceneFamily& family, std::size_t count,
                         std::uint64_t seed);

/// Whether what the candidate says about existence is so, by one-sided differences in 150 digits along the axes and the
/// diagonals: a gradient and a Hessian that it gives agree with those from all sides, and where it gives none, sides
/// disagree. Empty, or what is wrong.
std::string checkExistence(const SceneCandidate& candidate, const FlatlandScene& scene);

}  // namespace irradiff
