#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <string>
#include <vector>

namespace irradiff {

/// One input of a check: polygons that may hide each other, and a receiver.
struct OccludedScene {
  std::vector<Polygon> polygons;
  Receiver receiver;
};

/// The scene as one line of a scene file that `irradiff evaluate` reads; numbers read back to the same doubles.
std::string sceneLine(const OccludedScene& scene);

/// Largest difference between two vertices in one coordinate, in metres.
double extentOf(const OccludedScene& scene);

}  // namespace irradiff
