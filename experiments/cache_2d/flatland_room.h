#pragma once

#include "derivatives/scene/segment.h"

#include <filesystem>
#include <string>
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

/// Reads {"format": "irradiff-room", "version": 1, "dimension": 2, "description": ..., "segments": [{"name",
/// "vertices", "radiance", "reflectance"}]}. Throws SceneFileError or InvalidScene naming the place, the value and the
/// rule; also if nothing radiates or nothing reflects.
FlatlandRoom readFlatlandRoom(const std::filesystem::path& path);

}  // namespace irradiff
