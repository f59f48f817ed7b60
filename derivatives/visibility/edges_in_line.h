#pragma once

#include "derivatives/visibility/depth_order.h"
#include "derivatives/visibility/edge_crossings.h"
#include "derivatives/visibility/edge_view.h"
#include "derivatives/visibility/scene_in_view.h"

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// How the edges that lie over an exposed piece of an edge, or under it, stand to it.
struct EdgesInLine {
  bool is_carrier = true;            ///< none of them is nearer, and none on its line comes before it in the mesh
  std::vector<std::size_t> on_line;  ///< those on one line with it
  std::size_t ambiguous = kNone;     ///< the first of the nearer ones with which irradiance is not smooth
};

/// `in_line` are edges in the same plane of view, `beside` the faces beside the span and `piece` the nearest of them.
EdgesInLine edgesInLine(const SceneInView& scene, const EdgeSpan& span, std::span<const std::size_t> in_line,
                        std::span<const FaceBeside> beside, const EdgePiece& piece);

}  // namespace irradiff
