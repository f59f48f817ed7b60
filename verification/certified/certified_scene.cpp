#include "verification/certified/certified_scene.h"

#include "derivatives/form_factor/prepared_polygon.h"
#include "derivatives/scene/exact_sum.h"
#include "verification/certified/certified_sources.h"
#include "verification/certified/ladder.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace irradiff {

namespace {

/// How many apparent vertices' motion changes the Hessian.
std::size_t movingApparentVertices(const SceneComposition& scene) {
  const auto radiance = [&scene](std::size_t polygon) { return polygon == kNone ? 0.0 : scene.partly_hidden[polygon]; };
  const auto moves = [&radiance](const ApparentVertex& vertex) {
    ExactSum<double, 4> change;
    change.add(radiance(vertex.before.right));
    change.add(-radiance(vertex.before.left));
    change.add(radiance(vertex.after.left));
    change.add(-radiance(vertex.after.right));
    return change.sign() != 0;
  };
  return static_cast<std::size_t>(std::ranges::count_if(scene.view.apparent_vertices, moves));
}

}  // namespace

CertifiedScene<3> certifyScene(const SceneEvaluator& evaluator, const Receiver& receiver, double tolerance) {
  requireTolerance(tolerance);
  const SceneComposition scene = evaluator.compose(receiver);
  SceneEvaluation<3> dark = scene.dark;
  std::vector<PreparedPolygon> prepared;
  prepared.reserve(scene.whole.size());
  std::vector<LadderSource<3>> sources;
  for (const std::size_t i : scene.whole) {
    const Polygon& polygon = evaluator.polygons()[i];
    prepared.push_back(preparePolygon(polygon, i, receiver));
    sources.push_back({polygon.radiance,
                       [&receiver, &source = prepared.back()](const LadderStep& step) {
                         return polygonValue(source, receiver, step);
                       },
                       {},
                       {}});
  }
  if (scene.firstPartlyHidden()) {
    sources.push_back(
        {1.0, [&](const LadderStep& step) { return viewValue(evaluator.mesh(), scene, receiver, step); }, {}, {}});
    dark.apparent_vertices = movingApparentVertices(scene);
  }
  return climbTogether(dark, sources, receiver, tolerance);
}

}  // namespace irradiff
