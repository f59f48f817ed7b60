#pragma once

#include "verification/checks/random.h"
#include "verification/occlusion/occluded_scene.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace irradiff {

/// A family of seeded random scenes.
struct SceneFamily {
  std::string_view name;
  std::string_view description;
  /// Whether scenes are built upon visibility events or singular places, which the receiver may be as near as 1e-16:
  /// derivatives are large there.
  bool is_near_events;
  OccludedScene (*draw)(KeyedRandom&);
};

/// Well-conditioned first.
const std::vector<SceneFamily>& sceneFamilies();

/// Throws std::invalid_argument if there is no family of that name.
const SceneFamily& sceneFamily(std::string_view name);

/// The scene at `index` depends on seed, family and index alone. Its polygons and its receiver are valid.
OccludedScene drawScene(const SceneFamily& family, std::uint64_t seed, std::uint64_t index);

/// Whether all receivers about this one at `distance` times the scene's extent, in the 26 directions to the cells
/// around a cell, see the same topology. Necessary for there being no visibility event within that distance, and not
/// sufficient: an event's surface may pass between the 26. Nothing tells the distance itself short of a search over all
/// triples of edges.
bool isClearOfEvents(const OccludedScene& scene, double distance);

}  // namespace irradiff
