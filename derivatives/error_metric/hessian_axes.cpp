#include "derivatives/error_metric/hessian_axes.h"

#include <cmath>

namespace irradiff {
namespace {

/// A power of two such that the matrix times it has entries of at most 1, the largest at least 1/2: no square of theirs
/// over- or underflows unnoticed.
int exponentOf(const Eigen::Matrix2d& matrix) {
  int exponent = 0;
  std::frexp(matrix.cwiseAbs().maxCoeff(), &exponent);
  return exponent;
}

}  // namespace

HessianAxes hessianAxes(const TangentialHessian<double>& hessian) {
  const int exponent = exponentOf(hessian.value);
  const Eigen::Matrix2d h = hessian.value.unaryExpr([exponent](double v) { return std::ldexp(v, -exponent); });
  const double middle = 0.5 * (h(0, 0) + h(1, 1));
  const double half_difference = 0.5 * (h(0, 0) - h(1, 1));
  const double radius = std::hypot(half_difference, h(0, 1));

  // Of the larger eigenvalue, middle + radius: the sum of two numbers of one sign, whichever of a and c is larger.
  Eigen::Vector2d upper = half_difference >= 0.0 ? Eigen::Vector2d(half_difference + radius, h(0, 1))
                                                 : Eigen::Vector2d(h(0, 1), radius - half_difference);
  // Nothing there: a multiple of the identity, all axes of which are as good.
  upper = radius > 0.0 ? Eigen::Vector2d(upper / std::hypot(upper(0), upper(1))) : Eigen::Vector2d(1.0, 0.0);
  const Eigen::Vector2d lower(-upper(1), upper(0));

  HessianAxes result;
  if (middle >= 0.0) {
    result.eigenvalues << middle + radius, middle - radius;
    result.axes << upper, lower;
  } else {
    result.eigenvalues << middle - radius, middle + radius;
    result.axes << lower, -upper;
  }
  result.eigenvalues = result.eigenvalues.unaryExpr([exponent](double v) { return std::ldexp(v, exponent); });
  return result;
}

}  // namespace irradiff
