#pragma once

#include "derivatives/scene/receiver.h"

#include <Eigen/Core>

#include <cstddef>

namespace irradiff {

/// A parallelogram of receivers with one normal. Its sides u and v (metres) start at `origin`; cell (i, j), column
/// i < width of row j < height, has its receiver at its middle. Nothing is validated here.
struct ReceiverGrid {
  Eigen::Vector3d origin;
  Eigen::Vector3d u;
  Eigen::Vector3d v;
  Eigen::Vector3d normal;
  std::size_t width = 0;
  std::size_t height = 0;

  Receiver receiver(std::size_t i, std::size_t j) const {
    const double column = (static_cast<double>(i) + 0.5) / static_cast<double>(width);
    const double row = (static_cast<double>(j) + 0.5) / static_cast<double>(height);
    return {origin + column * u + row * v, normal};
  }
};

}  // namespace irradiff
