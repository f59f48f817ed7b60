#pragma once

#include "experiments/figures/derivative_map.h"
#include "experiments/figures/view_evaluation.h"
#include "experiments/io/receiver_grid.h"

#include <Eigen/Core>

namespace irradiff {

/// E = offset + slope.p + p^T curvature p / 2 at the position p: what it and its derivatives are is plain. Units as of
/// E, metres. Curvature is symmetric.
struct QuadraticField {
  double offset = 0.0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();

  SceneEvaluation<3> at(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) const;
};

/// The field, with one topology everywhere.
ViewEvaluator evaluatorOf(const QuadraticField& field);

/// Over the unit square in z = 0, x along columns.
ReceiverGrid unitGrid(std::size_t width, std::size_t height);

/// A map of width x height with E = 10 j + i in cell (i, j), of slope (1, -2, 0) throughout, and a Hessian of
/// eigenvalues 3, 1, -4 along x, y, z.
DerivativeMap plainMap(std::size_t width, std::size_t height);

}  // namespace irradiff
