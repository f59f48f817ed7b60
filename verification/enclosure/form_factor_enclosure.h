#pragma once

#include "verification/enclosure/ball_vector.h"

#include <Eigen/Core>

namespace irradiff {

/// F of a polygon (1), its gradient (1/m) and its Hessian (1/m^2) with respect to the receiver's position, n and
/// polygon fixed, and its gradient with respect to n (1), taken as any vector: n x normal_gradient is the rotational
/// gradient. F > 0 when the vertices run clockwise seen from the receiver; E = pi L F. Every number is proven to
/// lie in its ball.
struct FormFactorEnclosure {
  Ball value;
  BallVector gradient;
  BallMatrix hessian;
  BallVector normal_gradient;
};

/// Correct decimal digits of a vector norm-wise: the largest radius of a component against the largest magnitude of
/// one. 0 when a component is not finite or the vector is not told from zero; huge when all are exact.
template <class Components>
double normwiseDigits(const Eigen::MatrixBase<Components>& components) {
  Ball norm;
  Ball error;
  for (Eigen::Index i = 0; i < components.rows(); ++i) {
    for (Eigen::Index j = 0; j < components.cols(); ++j) {
      const Ball& component = components(i, j);
      if (!component.isFinite()) return 0;
      norm = max(norm, abs(component.midpoint()));
      error = max(error, component.radius());
    }
  }
  arb_add_error(norm.get(), error.get());
  return norm.digits();
}

/// Correct decimal digits of the worst of value and derivatives, each norm-wise.
double correctDigits(const FormFactorEnclosure& enclosure);

}  // namespace irradiff
