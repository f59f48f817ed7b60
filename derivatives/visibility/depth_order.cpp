#include "derivatives/visibility/depth_order.h"

#include <algorithm>

namespace irradiff {

int compareFaces(const SceneInView& scene, const EdgeSpan& span, EdgeSide side, std::size_t first, std::size_t second) {
  const PlaneSide first_side = scene.mesh().sideOfPlane(first, second);
  if (first_side == PlaneSide::kInPlane) return 0;
  if (first_side != PlaneSide::kCrosses) {
    return static_cast<int>(first_side) == scene.receiverOffset(second) ? 1 : -1;
  }
  const PlaneSide second_side = scene.mesh().sideOfPlane(second, first);
  if (second_side != PlaneSide::kCrosses) {
    return static_cast<int>(second_side) == scene.receiverOffset(first) ? -1 : 1;
  }
  const ViewPredicates& predicates = scene.predicates();
  if (const int at_first = predicates.compareFaces(span.edge, span.first, first, second); at_first != 0) {
    return at_first;
  }
  if (const int at_last = predicates.compareFaces(span.edge, span.last, first, second); at_last != 0) return at_last;
  const int beside = predicates.compareFacesRight(span.edge, first, second);
  return side == EdgeSide::kRight ? beside : -beside;
}

bool isNearer(const SceneInView& scene, std::size_t face, const EdgeSpan& span) {
  if (face == kNone) return false;
  const MeshEdge& e = scene.edge(span.edge);
  if (std::ranges::find(e.faces, face) != e.faces.end()) return false;
  const int start = scene.mesh().planeOffset(face, e.start) * scene.receiverOffset(face);
  const int end = scene.mesh().planeOffset(face, e.end) * scene.receiverOffset(face);
  if (start >= 0 && end >= 0) return false;
  if (start <= 0 && end <= 0) return true;
  const int at_first = scene.predicates().compareDepth(span.edge, span.first, face);
  return (at_first != 0 ? at_first : scene.predicates().compareDepth(span.edge, span.last, face)) < 0;
}

}  // namespace irradiff
