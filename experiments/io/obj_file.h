#pragma once

#include "experiments/io/obj_lines.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace irradiff {

/// A face as the file gives it: of any shape.
struct ObjFace {
  std::string name;                   ///< "GROUP face N", counted from 1 over the file; "face N" outside groups
  std::vector<std::size_t> vertices;  ///< at least 3 indices into the vertices of the model
  double radiance = 0.0;              ///< of its material
  std::size_t line = 0;               ///< in the file, from 1
};

/// The faces of a Wavefront OBJ file.
struct ObjModel {
  std::filesystem::path file;  ///< as messages call it
  std::vector<Eigen::Vector3d> vertices;
  std::vector<ObjFace> faces;
  std::size_t other_elements = 0;  ///< points, lines, curves and surfaces, which are not faces and not read
};

/// Reads an OBJ file, called `file` in messages, and the MTL files that it names, relative to its folder (mtl_file.h).
/// A face belongs to the group or object named last. Coordinates are read to the nearest double. Normals, texture
/// coordinates, weights, colours and what is not a face are skipped; a face without a material has radiance 0.
///
/// Throws ObjFileError with file, line, value and rule for
///   - a vertex without three finite numbers;
///   - a face with less than three vertices, an index that is no whole number, or one of a vertex that the file does
///   not have (negative indices count back from the vertex before the face);
///   - an MTL file that is not there or is wrong, or a material that is in none;
///   - a file without faces.
/// And as readObjLines does.
ObjModel readObjFile(std::istream& stream, const std::filesystem::path& file);

}  // namespace irradiff
