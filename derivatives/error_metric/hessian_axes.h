#pragma once

#include "derivatives/boundary/irradiance.h"

#include <Eigen/Core>

namespace irradiff {

/// The Hessian in the tangent plane along its own axes, in which the ellipse of an error metric has its half-axes.
struct HessianAxes {
  Eigen::Vector2d eigenvalues;  ///< with their signs, |first| >= |second|; W/m^4
  Eigen::Matrix2d axes;         ///< columns: their unit eigenvectors, right-handed, in the frame of the Hessian
};

// H = A diag(l1, l2) A^T. An axis belongs to an eigenvalue with its sign: the error metrics take |l1| and |l2| for
// lengths, but an eigenvector computed from |l1| is wrong by up to 90 degrees where l1 < 0 (docs/regressions.md).
// By (l1 - l2)/2 = hypot((a - c)/2, b) for H = [[a, b], [b, c]], without trigonometry: a diagonal H has axes that are
// exactly those of the frame, a multiple of the identity the frame itself, and powers of two in the unit of length
// change no axis. Errors: eigenvalues 4 u |l1|, A diag A^T - H likewise. Requires a finite Hessian whose entries off
// the diagonal are equal.
HessianAxes hessianAxes(const TangentialHessian<double>& hessian);

}  // namespace irradiff
