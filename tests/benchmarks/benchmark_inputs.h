#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <cstddef>
#include <vector>

namespace irradiff {

/// Polygons seen from one receiver, all above its horizon and with vertices clockwise seen from it: what every variant
/// can evaluate.
struct BenchmarkInputs {
  Receiver receiver;
  std::vector<Polygon> polygons;
};

enum class SourceSize {
  kLarge,  ///< about as large as far: evaluatePolygon integrates along the boundary
  kSmall,  ///< 0.001 of the distance: evaluatePolygon integrates over the area
};

/// Random regular polygons, the same at every call.
BenchmarkInputs benchmarkInputs(std::size_t edges, SourceSize size);

}  // namespace irradiff
