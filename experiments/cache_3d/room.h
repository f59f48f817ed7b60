#pragma once

#include "derivatives/scene/polygon.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// A pinhole camera: pixel (i, j), row 0 at the top, looks through the middle of its cell of the image plane.
struct Camera {
  Eigen::Vector3d position;
  Eigen::Vector3d target;
  Eigen::Vector3d up;
  double field_of_view = 40.0;  ///< vertical, degrees
};

/// A scene with interreflection: Lambertian polygons with emission (Polygon::radiance) and reflectance, seen by a
/// camera. Indirect irradiance of one bounce: what arrives from surfaces that the emitters light directly.
struct Room {
  std::string name;
  std::string description;
  std::vector<Polygon> polygons;
  std::vector<double> reflectances;  ///< of each polygon, in [0, 1]
  Camera camera;
};

/// Reads {"format": "irradiff-room", "version": 1, "dimension": 3, "description": ..., "polygons": [{"name",
/// "vertices", "radiance", "reflectance"}], "camera": {"position", "target", "up", "field_of_view"}}. "description" and
/// names may be missing; no other field may be, and no unknown one there. The room is called as the file, without its
/// extension. Throws SceneFileError or InvalidScene naming the place, the value and the rule; also if nothing radiates
/// (a black room), if nothing reflects, or if the camera is on a polygon or sees none that may have a record: one that
/// does not radiate. std::runtime_error if the file cannot be read.
Room readRoom(const std::filesystem::path& path);

/// The same from the text of a file; the room's name is `name`.
Room parseRoom(std::string_view json_text, const std::string& name);

/// All that a room's light depends on, as text: two rooms with the same have the same irradiance everywhere.
std::string roomFingerprint(const Room& room);

/// The largest difference between two vertices in one coordinate; m.
double extentOf(const Room& room);

}  // namespace irradiff
