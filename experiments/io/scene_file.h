#pragma once

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"
#include "experiments/io/json_text.h"
#include "experiments/io/receiver_grid.h"
#include "experiments/io/scene_fields.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// A scene and the receivers in it. In 3D: polygons and receivers; in 2D: segments and flatland receivers.
struct Scene {
  int dimension = 3;
  std::string description;  ///< what the scene is for; empty if not given
  std::vector<Polygon> polygons;
  std::vector<Segment> segments;
  std::vector<Receiver> receivers;
  std::optional<ReceiverGrid> grid;  ///< whose receivers are the last of `receivers`
  std::vector<FlatlandReceiver> flatland_receivers;
};

/// Most receivers that one scene may have, points and grid together.
inline constexpr std::size_t kMaxReceivers = std::size_t{1} << 22;

/// Reads a scene from its JSON text:
///
///     {"format": "irradiff-scene", "version": 1, "dimension": 3, "description": "why this scene exists",
///      "polygons": [{"name": "emitter", "vertices": [[x,y,z], ...], "radiance": 1.0}],
///      "points":   [{"position": [x,y,z], "normal": [x,y,z]}],
///      "grid":     {"origin": [x,y,z], "u": [x,y,z], "v": [x,y,z], "resolution": [w,h], "normal": [x,y,z]}}
///
/// With "dimension": 2 it has "segments" of two vertices instead of polygons, two components everywhere, and no grid.
/// "description" may be missing. So may a name; then it is "polygon 3" or "segment 3", counted from 0. "points" or
/// "grid" or both give at least one receiver: the points first, then the grid in row-major order, j being the row: the
/// receiver of cell (i, j) is at its middle, origin + u (i + 0.5) / w + v (j + 0.5) / h, so u and v are the full sides
/// of the grid. Every other field must be there and no unknown one may be. Numbers are read to the nearest double.
///
/// Throws SceneFileError, naming the field, for text that is not such a file, and InvalidScene for one whose polygons,
/// segments or receivers do not pass `validate`. A receiver's index in a message is its index in the returned vector.
Scene parseScene(std::string_view json_text);

}  // namespace irradiff
