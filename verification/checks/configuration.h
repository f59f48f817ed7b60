#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <string>

namespace irradiff {

/// One input of a check: a polygon, its vertices in a definite order, and a receiver. F > 0 when the vertices run
/// clockwise seen from the receiver.
struct Configuration {
  Polygon polygon;
  Receiver receiver;
};

/// The configuration as one line of a scene file that `irradiff evaluate` reads; numbers read back to the same doubles.
std::string sceneLine(const Configuration& configuration);

}  // namespace irradiff
