#include "experiments/cache_3d/static_pieces.h"

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/visibility/boundary_of_view.h"
#include "derivatives/visibility/view_unit.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace irradiff {
namespace {

/// A plane n.p = offset, p from the receiver.
struct SeenPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0.0;

  Eigen::Vector3d along(const Eigen::Vector3d& direction) const { return direction * (offset / normal.dot(direction)); }
};

/// Of each polygon, in units of the mesh.
std::vector<SeenPlane> seenPlanes(const SceneMesh& mesh, std::size_t polygons, const Eigen::Vector3d& position) {
  std::vector<SeenPlane> planes(polygons);
  for (const MeshFace& face : mesh.faces()) {
    const Eigen::Vector3d& corner = mesh.vertices()[face.plane[0]];
    const Eigen::Vector3d normal =
        (mesh.vertices()[face.plane[1]] - corner).cross(mesh.vertices()[face.plane[2]] - corner);
    planes[face.polygon] = {normal, normal.dot(corner - position)};
  }
  return planes;
}

}  // namespace

TangentialHessian<double> staticPiecesHessian(const SceneMesh& mesh, const VisibleBoundary& view,
                                              std::span<const double> radiances, const Receiver& receiver) {
  const Eigen::Vector3d position = positionIn(mesh, receiver);
  const detail::ViewGeometry<double, Wide<double>> geometry(mesh, 0, position, receiver.normal);
  const std::vector<SeenPlane> planes = seenPlanes(mesh, radiances.size(), position);
  RadianceBoundary<double> boundary;
  for (const VisibleArc& arc : view.arcs) {
    const Eigen::Vector3d first = narrow<double>(geometry.place(arc.edge, arc.first).position);
    const Eigen::Vector3d last = narrow<double>(geometry.place(arc.edge, arc.last).position);
    if (first == last) continue;
    const auto append = [&](std::size_t polygon, double sign) {
      if (polygon == kNone || radiances[polygon] == 0.0) return;
      const auto end = [&](const Eigen::Vector3d& direction) {
        const Eigen::Vector3d place = planes[polygon].along(direction);
        return ClippedVertex<double, double>{place, std::max(0.0, receiver.normal.dot(place))};
      };
      appendEdgeArcs(end(first), end(last), receiver.normal, sign * radiances[polygon], boundary.arcs);
    };
    append(arc.sides.right, 1.0);
    append(arc.sides.left, -1.0);
  }
  Eigen::Matrix2d hessian = boundarySums(boundary, receiver.normal).derivatives.tangential_hessian.value;
  return {hessian.unaryExpr([&](double v) { return std::ldexp(v, -2 * mesh.exponent()); })};
}

}  // namespace irradiff
