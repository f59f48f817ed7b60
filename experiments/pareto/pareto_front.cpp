#include "experiments/pareto/pareto_front.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

std::vector<bool> paretoFront(std::span<const TimeAndError> points) {
  std::vector<bool> on_front;
  on_front.reserve(points.size());
  for (const TimeAndError& point : points) {
    const bool is_beaten = std::ranges::any_of(points, [&point](const TimeAndError& other) {
      return other.time <= point.time && other.error <= point.error &&
             (other.time < point.time || other.error < point.error);
    });
    on_front.push_back(std::isfinite(point.error) && !is_beaten);
  }
  return on_front;
}

}  // namespace irradiff
