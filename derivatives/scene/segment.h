#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>

namespace irradiff {

/// A straight segment of a flatland (2D) scene; radiates and blocks on both sides, vertex order does not matter.
/// Vertices in metres; radiance in W/(m rad), constant over the segment and all directions.
struct Segment {
  std::string name;
  std::array<Eigen::Vector2d, 2> vertices;
  double radiance = 0.0;
};

/// Throws InvalidScene naming the segment (by name and `index`), the value and the rule, unless its vertices are finite
/// and distinct and its radiance is finite and >= 0.
void validate(const Segment& segment, std::size_t index);

}  // namespace irradiff
