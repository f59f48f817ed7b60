#pragma once

#include "derivatives/visibility/scene_in_view.h"
#include "derivatives/visibility/view_predicates.h"

#include <cstddef>
#include <cstdint>

namespace irradiff {

/// A side of an edge, as seen along it by the receiver.
enum class EdgeSide : std::uint8_t { kLeft, kRight };

/// An edge from one of its places to another, or at one: first == last. No edge of the mesh crosses it between them.
struct EdgeSpan {
  std::size_t edge;
  EdgePlace first;
  EdgePlace last;
};

/// Which of two faces that are seen beside a span is nearer on that side: 1 the first, -1 the second, 0 where they lie
/// in one plane.
int compareFaces(const SceneInView& scene, const EdgeSpan& span, EdgeSide side, std::size_t first, std::size_t second);

/// Whether a face that is seen beside a span is nearer than the edge. kNone, the background, is not.
bool isNearer(const SceneInView& scene, std::size_t face, const EdgeSpan& span);

}  // namespace irradiff
