#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <span>

namespace irradiff {

/// The smallest distance of a receiver from a plane through a vertex of one polygon and an edge of another, or through
/// a polygon: where the topology of its view may change because a vertex passes behind an edge or a plane turns its
/// other side. Not judged are planes parallel to the receiver's tangent plane, which receivers in that plane never
/// cross, and surfaces through three edges. Metres.
double eventDistance(std::span<const Polygon> polygons, const Receiver& receiver);

}  // namespace irradiff
