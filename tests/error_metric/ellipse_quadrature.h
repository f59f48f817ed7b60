#pragma once

#include "derivatives/error_metric/valid_region.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace irradiff::error_metric_test {

/// An integral and what the quadrature itself says about its error.
struct Quadrature {
  double value;
  double error_estimate;
};

/// 1/2 integral of |d^T H d| over the region, from its definition: adaptive Gauss-Kronrod across the ellipse, and in
/// between, where the form is a polynomial of degree 2, Gauss-Legendre between its roots. Knows nothing of eigenvalues.
Quadrature integrateHalfForm(const Eigen::Matrix2d& hessian, const ValidRegion& region);

/// The integral over the region of any function of a point, by Gauss-Kronrod in strips across the ellipse and
/// adaptively along each. `kinks` gives where along the strip through the point at `start` with the unit direction
/// `along` the function is not smooth. The value's error is of the order of 1e-9 of the largest value times the area.
double integrateOver(
    const ValidRegion& region, const std::function<double(const Eigen::Vector2d&)>& function,
    const std::function<std::vector<double>(const Eigen::Vector2d& start, const Eigen::Vector2d& along)>& kinks);

/// The positive square root of H^2 by the theorem of Cayley and Hamilton: |H|, without eigenvectors. H not zero.
Eigen::Matrix2d absoluteHessian(const Eigen::Matrix2d& hessian);

/// R diag(l1, l2) R^T, R the rotation by `angle`: a Hessian of which the axes are known.
Eigen::Matrix2d hessianOf(double l1, double l2, double angle);

}  // namespace irradiff::error_metric_test
