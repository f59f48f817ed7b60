#pragma once

#include "derivatives/scene/segment.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// A flatland scene with interreflection: Lambertian segments with emission (Segment::radiance) and reflectance.
/// Receivers are on both sides of every segment that reflects, as far as they see the inside of the room.
struct FlatlandRoom {
  std::string name;
  std::string description;
  std::vector<Segment> segments;
  std::vector<double> reflectances;  ///< of each segment, in [0, 1]
};

/// Reads a room from its JSON text: {"format": "irradiff-room", "version": 1, "dimension": 2, "description": ...,
/// "segments": [{"name", "vertices", "radiance", "reflectance"}]}. Throws SceneFileError or InvalidScene naming the
/// place, the value and the rule; also if nothing radiates or nothing reflects. "description" may be missing, and so
/// may a name.
FlatlandRoom parseFlatlandRoom(std::string_view json_text, const std::string& name);

/// The same from a file, whose name without extension is the room's. Throws std::runtime_error if it cannot be read.
FlatlandRoom readFlatlandRoom(const std::filesystem::path& path);

}  // namespace irradiff
