#include "derivatives/error_metric/valid_region.h"

#include "derivatives/error_metric/hessian_axes.h"

#include <cmath>
#include <numbers>

namespace irradiff {

double integratedError(const TangentialHessian<double>& hessian, const ValidRegion& region) {
  const Eigen::Matrix2d to_ellipse = region.axes * region.half_axes.asDiagonal();
  const Eigen::Matrix2d form = to_ellipse.transpose() * hessian.value * to_ellipse;
  const double middle = std::abs(0.5 * (form(0, 0) + form(1, 1)));
  const double radius = std::hypot(0.5 * (form(0, 0) - form(1, 1)), 0.5 * (form(0, 1) + form(1, 0)));
  const double area = region.half_axes.prod();
  if (middle >= radius) return area * 0.25 * std::numbers::pi * middle;
  // Where the two are nearly equal asin(middle / radius) has the root of its argument's rounding; atan2 has not. Two
  // roots, since the product may be beyond double.
  const double side = std::sqrt(radius - middle) * std::sqrt(radius + middle);
  return area * 0.5 * (middle * std::atan2(middle, side) + side);
}

double integratedErrorBound(const TangentialHessian<double>& hessian, const ValidRegion& region) {
  const HessianAxes own = hessianAxes(hessian);
  const Eigen::Matrix2d to_ellipse = region.axes * region.half_axes.asDiagonal();
  const Eigen::Vector2d squares = (own.axes.transpose() * to_ellipse).rowwise().squaredNorm();
  return region.half_axes.prod() * 0.125 * std::numbers::pi * own.eigenvalues.cwiseAbs().dot(squares);
}

}  // namespace irradiff
