#pragma once

#include "derivatives/visibility/scene_evaluation.h"

namespace irradiff {

/// What an evaluation has to do at one receiver, counted.
struct EvaluationWork {
  double polygons = 0.0;           ///< of the scene: each is scaled, cut and classified
  double boundary_edges = 0.0;     ///< of polygons that are seen whole and integrated along their edges
  double area_triangles = 0.0;     ///< of polygons that are seen whole and integrated over their area
  double view_edges = 0.0;         ///< of the mesh: each is followed through the view; 0 where nothing may be hidden
  double pairs = 0.0;              ///< an edge and another polygon that overlap in view, as cones about them tell
  double apparent_vertices = 0.0;  ///< whose motion counts
};

/// `composition` and `evaluation` at one receiver.
EvaluationWork workOf(const SceneEvaluator& evaluator, const SceneComposition& composition,
                      const SceneEvaluation<3>& evaluation, const Receiver& receiver);

/// The time of an evaluation in units of that of one square that is not hidden, in a scene of its own: a sum of the
/// counts with weights that were fitted to times on one machine. It is right to a factor of 2 or so: where much is
/// exactly in line, more has to be decided in exact numbers, which no count foresees. `./run bench` compares it with
/// what it measures.
double estimateCost(const EvaluationWork& work);

}  // namespace irradiff
