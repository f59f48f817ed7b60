#pragma once

#include <span>
#include <vector>

namespace irradiff {

struct TimeAndError {
  double time;
  double error;
};

/// Which of the points are on the Pareto front: no other is as fast and as exact, and better in one of the two. Points
/// whose error is not finite are not.
std::vector<bool> paretoFront(std::span<const TimeAndError> points);

}  // namespace irradiff
