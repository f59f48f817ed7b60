#pragma once

#include "derivatives/visibility/edge_crossings.h"
#include "derivatives/visibility/edge_view.h"
#include "derivatives/visibility/scene_in_view.h"

#include <optional>
#include <span>
#include <string>

namespace irradiff {

/// Whether the receiver is at a visual event, on a surface across which the topology of its view changes: three edges,
/// or a vertex and a foreign edge, or two vertices meet in view where the radiances about them differ. The Hessian does
/// not exist there (docs/derivations/visibility.md, section 4); the text says what meets. Empty if nothing does.
///
/// `views` of all edges of the mesh, `at_ends` found along all.
std::optional<std::string> visualEvent(const SceneInView& scene, std::span<const EdgeView> views,
                                       std::span<const Alignment> at_ends);

}  // namespace irradiff
