#pragma once

#include "experiments/io/receiver_grid.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace irradiff {

/// Irradiance over a grid's rectangle, from its values and gradients at the receivers: each of the four around a point
/// adds its bilinear weight times E_i + grad E_i.(p - p_i)/2. Exact for quadratic functions (docs/derivations/
/// reprojection.md, section 8), and continuous.
class TrueIrradiance {
 public:
  /// Values and gradients row-major in the grid. Requires a grid that validateFrame accepts.
  TrueIrradiance(const ReceiverGrid& grid, std::vector<double> values, std::vector<Eigen::Vector3d> gradients);

  /// W/m^2; nothing outside of the rectangle, where there is no receiver. Requires a position in the grid's plane.
  std::optional<double> at(const Eigen::Vector3d& position) const;

  const ReceiverGrid& grid() const { return grid_; }
  const std::vector<double>& values() const { return values_; }
  const std::vector<Eigen::Vector3d>& gradients() const { return gradients_; }

 private:
  ReceiverGrid grid_;
  std::vector<double> values_;
  std::vector<Eigen::Vector3d> gradients_;
};

}  // namespace irradiff
