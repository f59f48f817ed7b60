#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "experiments/atlas/stability_map.h"
#include "verification/occlusion/occluded_scene.h"

namespace irradiff {

/// Two triangles, one partly behind the other: an edge of the nearer one is seen to cross an edge of the farther one at
/// `along` of its length from a corner, at an angle with this sine. Where both are small, two visibility events are
/// near. Requires 0 < along < 1 and 0 < sine <= 1; no special direction.
OccludedScene drawNearEvent(KeyedRandom& random, double along, double sine);

/// `along` and `sine` as the rounded coordinates have them.
std::array<double, 2> measureNearEvent(const OccludedScene& scene);

/// max|d|/max|true| of E, gradient and Hessian; infinite where `actual` says that there is no derivative.
AtlasErrors sceneErrors(const SceneEvaluation<3>& actual, const SceneEvaluation<3>& truth);

/// Errors of the evaluators of scenes, the plain one in double and the certified one, against exact visibility and
/// enclosures (verification/exact_boundary), whose own rounding to double limits what is seen to 1.1e-16. NaN where
/// rounding has moved the crossing by more than a quarter or derivatives do not exist, infinite where an evaluator
/// refuses what exists.
ErrorProbe probeScene(const OccludedScene& scene, double along, double sine);

/// The map below with errors of 0.
StabilityMap emptyEventMap(const AtlasPlan& plan);

/// The map of distance to a visibility event against the angle of crossing. Takes tiles of `finished` behind those of
/// the polygon maps. As polygonStability.
StabilityMap eventStability(const AtlasPlan& plan, unsigned threads, const TileStore* finished,
                            const QualityProgress& progress);

}  // namespace irradiff
