#pragma once

#include "derivatives/samples/stratification.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace irradiff {

/// The receiver and the right-handed orthonormal frame in which the hemisphere above it is sampled. Metres.
struct SampleFrame {
  Eigen::Vector3d position;
  Eigen::Vector3d tangent;
  Eigen::Vector3d bitangent;
  Eigen::Vector3d normal;

  /// Columns t, b, n: takes components in the frame to the world.
  Eigen::Matrix3d axes() const {
    Eigen::Matrix3d columns;
    columns << tangent, bitangent, normal;
    return columns;
  }
};

/// What was seen from the receiver along one ray in each stratum, row by row.
///
/// Directions are unit vectors in the frame (t, b, n), each inside its stratum but for rounding and not below the
/// horizon. A hit at distance r is stored as 1/r: a ray that hits nothing has 0, so that what is infinitely far needs
/// no case of its own. Arrays have shape.size() entries.
struct HemisphereSamples {
  SampleFrame frame;
  Stratification stratification = Stratification::kConcentric;
  GridShape shape;
  std::vector<double> direction_t, direction_b, direction_n;
  std::vector<double> inverse_distance;  ///< 1/m, finite, >= 0
  std::vector<double> radiance;          ///< W/(m^2 sr), finite, >= 0

  Eigen::Vector3d direction(std::size_t sample) const {
    return {direction_t[sample], direction_b[sample], direction_n[sample]};
  }
};

}  // namespace irradiff
