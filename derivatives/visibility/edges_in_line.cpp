#include "derivatives/visibility/edges_in_line.h"

#include <algorithm>
#include <iterator>

namespace irradiff {
namespace {

bool bounds(const MeshEdge& edge, std::size_t face) { return std::ranges::find(edge.faces, face) != edge.faces.end(); }

/// Whether irradiance is smooth although `near` lies over the span of a farther edge: what comes to be seen between
/// them, on whichever side, is as bright as what is seen on that side now, so that the farther edge bounds nothing.
/// `is_pair`: no third edge lies over them.
bool isSmooth(const SceneInView& scene, const EdgeSpan& span, std::size_t near, bool is_pair,
              std::span<const FaceBeside> beside, const EdgePiece& piece) {
  const double left = scene.radianceOf(piece.left_face);
  const double right = scene.radianceOf(piece.right_face);
  const MeshEdge& f = scene.edge(span.edge);
  const MeshEdge& n = scene.edge(near);
  std::size_t behind = kNone;  // the nearest face that lies over both sides and has neither edge
  std::size_t far_left = kNone;
  std::size_t far_right = kNone;
  bool near_has_left = false;
  bool near_has_right = false;
  for (const FaceBeside& candidate : beside) {
    const auto keepNearest = [&](std::size_t& nearest, EdgeSide side) {
      if (nearest == kNone || compareFaces(scene, span, side, candidate.face, nearest) > 0) nearest = candidate.face;
    };
    const bool of_far = bounds(f, candidate.face);
    const bool of_near = bounds(n, candidate.face);
    if (of_far && candidate.left) keepNearest(far_left, EdgeSide::kLeft);
    if (of_far && candidate.right) keepNearest(far_right, EdgeSide::kRight);
    if (candidate.left && candidate.right && !of_far && !of_near) keepNearest(behind, EdgeSide::kLeft);
    near_has_left = near_has_left || (of_near && candidate.left);
    near_has_right = near_has_right || (of_near && candidate.right);
  }
  // A face seen edge-on between them shows itself on both sides, a crease or a third edge more than this looks at: then
  // everything about must be equally bright.
  bool is_plain = is_pair && !f.is_crease && !n.is_crease;
  std::vector<double> radiances{scene.radianceOf(behind)};
  for (const MeshEdge* e : {&f, &n}) {
    for (const std::size_t face : e->faces) {
      if (!scene.isPresentFace(face)) continue;
      radiances.push_back(scene.radianceOf(face));
      is_plain = is_plain && scene.receiverOffset(face) != 0;
    }
  }
  if (!is_plain) {
    return left == right && std::ranges::all_of(radiances, [&](double radiance) { return radiance == left; });
  }
  // The near edge's own faces hide the strip on their side; where it has none, the strip shows the far edge's face on
  // the other side of that, or what is behind.
  const auto shown = [&](std::size_t face) { return scene.radianceOf(face == kNone ? behind : face); };
  return (near_has_left || shown(far_right) == left) && (near_has_right || shown(far_left) == right);
}

}  // namespace

EdgesInLine edgesInLine(const SceneInView& scene, const EdgeSpan& span, std::span<const std::size_t> in_line,
                        std::span<const FaceBeside> beside, const EdgePiece& piece) {
  const ViewPredicates& predicates = scene.predicates();
  std::vector<std::size_t> covering;
  std::ranges::copy_if(in_line, std::back_inserter(covering),
                       [&](std::size_t other) { return predicates.covers(other, span.edge, span.first, span.last); });
  EdgesInLine result;
  for (const std::size_t other : covering) {
    const int order = predicates.compareInLine(span.edge, other, span.first, span.last);
    if (order == 0) result.on_line.push_back(other);
    if (order < 0 || (order == 0 && other < span.edge)) result.is_carrier = false;
    if (order < 0 && result.ambiguous == kNone && !isSmooth(scene, span, other, covering.size() == 1, beside, piece)) {
      result.ambiguous = other;
    }
  }
  return result;
}

}  // namespace irradiff
