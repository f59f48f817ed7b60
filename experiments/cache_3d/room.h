#pragma once

#include "derivatives/scene/polygon.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <string>
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
/// "vertices", "radiance", "reflectance"}], "camera": {"position", "target", "up", "field_of_view"}}. Throws
/// SceneFileError or InvalidScene naming the place, the value and the rule; also if nothing radiates (a black room), if
/// nothing reflects, or if the camera sees no surface.
Room readRoom(const std::filesystem::path& path);

}  // namespace irradiff
