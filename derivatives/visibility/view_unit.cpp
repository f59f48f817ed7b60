#include "derivatives/visibility/view_unit.h"

#include "derivatives/visibility/boundary_of_view.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

namespace {

Eigen::Vector3d scaledBy(const Eigen::Vector3d& v, int exponent) {
  return v.unaryExpr([exponent](double c) { return std::ldexp(c, exponent); });
}

}  // namespace

Eigen::Vector3d positionIn(const SceneMesh& mesh, const Receiver& receiver) {
  return scaledBy(receiver.position, -mesh.exponent());
}

ViewUnit viewUnit(const SceneMesh& mesh, const VisibleBoundary& view, std::span<const double> radiances,
                  const Receiver& receiver) {
  const Eigen::Vector3d position = positionIn(mesh, receiver);
  double farthest = 0.0;
  const auto include = [&](std::size_t edge) {
    const MeshEdge& e = mesh.edges()[edge];
    for (const std::size_t point : {e.start, e.end}) {
      for (const std::size_t vertex : {mesh.points()[point].start, mesh.points()[point].end}) {
        farthest = std::max(farthest, (mesh.vertices()[vertex] - position).cwiseAbs().maxCoeff());
      }
    }
  };
  for (const VisibleArc& arc : radianceArcs(view, radiances)) {
    include(arc.edge);
    for (const EdgePlace& place : {arc.first, arc.last}) {
      if (place.kind == EdgePlace::Kind::kEdge || place.kind == EdgePlace::Kind::kInLine) include(place.id);
    }
  }
  const int exponent = farthest > 0.0 ? std::ilogb(farthest) + 1 : 0;
  return {exponent, scaledBy(position, -exponent)};
}

}  // namespace irradiff
