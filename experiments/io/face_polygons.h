#pragma once

#include "derivatives/scene/polygon.h"
#include "experiments/io/obj_file.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// The polygons of a model's faces, and what had to be done to get them.
struct FacePolygons {
  std::vector<Polygon> polygons;     ///< in the order of the faces; every one passes `validate`
  std::size_t split_faces = 0;       ///< not planar, therefore split into triangles
  std::size_t triangles = 0;         ///< made of them
  std::size_t dropped_faces = 0;     ///< without an area
  std::size_t dropped_vertices = 0;  ///< equal to the vertex before them
};

/// Makes polygons of faces. A planar face is one polygon of the same name. One that is not planar by the rule of scenes
/// (`validate`) is split into triangles (face_triangulation.h), called "NAME.1", "NAME.2" and so on. A vertex equal to
/// the one before it, and a face or triangle without an area, change nothing in a scene and are left out.
///
/// Throws ObjFileError with file, line, face, value and rule for a face that meets itself: what it covers is not
/// defined; for one that is not planar and cannot be split; and where nothing is left.
FacePolygons facePolygons(const ObjModel& model);

}  // namespace irradiff
