#include "experiments/inspection/evaluation_cost.h"

#include <algorithm>

namespace irradiff {

EvaluationWork workOf(const SceneEvaluator& evaluator, const SceneComposition& composition,
                      const SceneEvaluation<3>& evaluation) {
  EvaluationWork work;
  const auto edgesOf = [&](std::size_t i) { return static_cast<double>(evaluator.polygons()[i].vertices.size()); };
  for (std::size_t i = 0; i < evaluator.polygons().size(); ++i) {
    work.polygons += 1.0;
    work.edges += edgesOf(i);
  }
  double whole_edges = 0.0;
  for (const std::size_t i : composition.whole) whole_edges += edgesOf(i);
  const auto whole = static_cast<double>(composition.whole.size());
  const auto area = evaluation.sources ? static_cast<double>(evaluation.sources->area_rule) : 0.0;
  if (whole > 0.0) {
    // The evaluation tells how many there are of both kinds, and not which.
    work.area_polygons = area;
    work.area_triangles = area * (whole_edges / whole - 2.0);
    work.boundary_polygons = whole - area;
    work.boundary_edges = (whole - area) * (whole_edges / whole);
  }
  const VisibleBoundary& view = composition.view;
  if (view.is_seen.empty()) return work;
  const SceneMesh& mesh = evaluator.mesh();
  work.views = 1.0;
  work.view_edges = static_cast<double>(mesh.edges().size());
  work.pairs = work.view_edges * static_cast<double>(mesh.faces().size());
  work.arcs = static_cast<double>(view.arcs.size());
  const auto radiance = [&](std::size_t polygon) {
    return polygon == kNone ? 0.0 : composition.partly_hidden[polygon];
  };
  work.summed_arcs = static_cast<double>(std::ranges::count_if(
      view.arcs, [&](const VisibleArc& arc) { return radiance(arc.sides.left) != radiance(arc.sides.right); }));
  work.apparent_vertices = static_cast<double>(evaluation.apparent_vertices);
  return work;
}

double estimateCost(const EvaluationWork& work) { return 1.0 * work.polygons + 0.1 * work.edges + work.views; }

}  // namespace irradiff
