#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <string_view>
#include <vector>

namespace irradiff {

class KeyedRandom;

struct SceneWithReceivers {
  std::vector<Polygon> polygons;  ///< exactly planar
  std::vector<Receiver> receivers;
};

struct SceneFamily {
  std::string_view name;
  SceneWithReceivers (*draw)(KeyedRandom&);
};

/// Random scenes in which visibility is hard to decide:
///   triangles  vertices of any double, many intersect each other; receivers among them
///   lattice    triangles and parallelograms on small integers: what is shared, in line, coplanar, edge-on, on the
///   horizon boxes      on a floor, with receivers on it and tilted ones above tiles      rectangles divided into
///   rectangles with T-junctions, at several heights, some in the same plane of view blades     L- and U-shaped
///   polygons and rectangles in the planes of the axes that pass through each other dark       as lattice, with few
///   radiances of which one is 0
const std::vector<SceneFamily>& degenerateSceneFamilies();

}  // namespace irradiff
