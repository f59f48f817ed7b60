#include "data/reference/reference_inputs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdio>

namespace irradiff {

PolygonFamily facingReceiver(PolygonFamily family) {
  for (ReferenceInput& input : family.inputs) {
    // In units of a distance, because the product of three coordinates need not be a double.
    const double size = (input.vertices[0] - input.position).stableNorm();
    const auto relative = [&](std::size_t i) { return Eigen::Vector3d((input.vertices[i] - input.position) / size); };
    double volume = 0;
    for (std::size_t i = 1; i + 1 < input.vertices.size(); ++i) {
      volume += relative(0).dot(relative(i).cross(relative(i + 1)));
    }
    if (volume < 0) std::reverse(input.vertices.begin(), input.vertices.end());
  }
  return family;
}

std::string scientific(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.0e", value);
  return text.data();
}

}  // namespace irradiff
