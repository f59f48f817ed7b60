#pragma once

#include "verification/enclosure/ball_vector.h"
#include "verification/enclosure/second_order_taylor.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff::enclosure {

/// What decides whether a height is above the horizon.
inline const Ball& valueOf(const Ball& x) { return x; }
template <std::size_t N>
const Ball& valueOf(const SecondOrderTaylor<Ball, N>& x) {
  return x.value;
}

/// The part of a polygon or segment above the horizon n.p > 0. Vertices are relative to the receiver, in order; the cut
/// points are r + (r' - r) h / (h - h') with h = n.r, so that with Taylor scalars they carry their motion. Empty when
/// nothing is above. `closed` says whether the last vertex is joined to the first (a polygon) or not (a segment).
/// Throws std::domain_error when a vertex is on the horizon: the Hessian does not exist there.
template <class Scalar, int Dimension>
std::vector<Eigen::Matrix<Scalar, Dimension, 1>> aboveHorizon(
    const std::vector<Eigen::Matrix<Scalar, Dimension, 1>>& vertices, const Eigen::Matrix<Scalar, Dimension, 1>& normal,
    bool closed) {
  using Point = Eigen::Matrix<Scalar, Dimension, 1>;
  std::vector<Scalar> heights;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    heights.push_back(dot(normal, vertices[i]));
    if (valueOf(heights[i]).containsZero()) {
      throw std::domain_error("vertex " + std::to_string(i) + " of a piece of the polygon is at height " +
                              valueOf(heights[i]).toDecimal(5) +
                              " above the receiver's horizon; it must not be on the horizon");
    }
  }
  const auto is_above = [&](std::size_t i) { return valueOf(heights[i]) > Ball(0); };
  std::vector<Point> result;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (is_above(i)) result.push_back(vertices[i]);
    if (i + 1 == vertices.size() && !closed) break;
    const std::size_t j = (i + 1) % vertices.size();
    if (is_above(i) != is_above(j)) {
      const Scalar t = heights[i] / (heights[i] - heights[j]);
      Point cut;
      for (Eigen::Index k = 0; k < Dimension; ++k) cut(k) = vertices[i](k) + (vertices[j](k) - vertices[i](k)) * t;
      result.push_back(cut);
    }
  }
  return result;
}

}  // namespace irradiff::enclosure
