#pragma once

#include "derivatives/visibility/scene_evaluation.h"

namespace irradiff {

/// What an evaluation has to do at one receiver, counted.
struct EvaluationWork {
  double polygons = 0.0;           ///< of the scene: each is scaled, cut and classified
  double edges = 0.0;              ///< theirs
  double boundary_polygons = 0.0;  ///< seen whole, integrated along their edges
  double boundary_edges = 0.0;
  double area_polygons = 0.0;  ///< seen whole, integrated over their triangles
  double area_triangles = 0.0;
  double views = 0.0;              ///< 1 if something may be hidden, else 0
  double view_edges = 0.0;         ///< of the mesh: each is followed through the view
  double pairs = 0.0;              ///< an edge and a polygon of the mesh that may hide it
  double arcs = 0.0;               ///< of the view's boundary
  double summed_arcs = 0.0;        ///< those beside something partly hidden
  double apparent_vertices = 0.0;  ///< whose motion counts
};

/// `composition` and `evaluation` at one receiver.
EvaluationWork workOf(const SceneEvaluator& evaluator, const SceneComposition& composition,
                      const SceneEvaluation<3>& evaluation);

/// The time of an evaluation in units of that of one square that is not hidden (SceneEvaluator, a scene of that square
/// alone): a sum of the counts with weights that were fitted to measured times on one machine. `./run bench` compares
/// it with what it measures.
double estimateCost(const EvaluationWork& work);

}  // namespace irradiff
