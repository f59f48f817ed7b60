#pragma once

#include "derivatives/scene/polygon.h"

#include <array>
#include <cstddef>
#include <vector>

namespace irradiff {

/// Triangles between the vertices of a simple polygon, as indices of its vertices: n - 2 of them for n vertices, which
/// cover it without overlaps and turn the way the polygon does. None has an area of zero, also where three vertices in
/// a row are on one line: a vertex opposite such a row is then joined to each vertex in it. (That is always possible:
/// a simple polygon of more than three vertices has a diagonal that meets its boundary in its two ends only, and what
/// is left on either side is a simple polygon again.)
/// All of this is meant and decided exactly in the projection that `validate` judges: the coordinates given, without
/// the one in which the plane is steepest. The same triangles on every run and machine; time n log n. Requires a
/// polygon that `validate` accepts.
std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon);

}  // namespace irradiff
