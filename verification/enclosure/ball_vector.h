#pragma once

#include "verification/enclosure/ball.h"

#include <Eigen/Core>

namespace irradiff {

using BallVector = Eigen::Matrix<Ball, 3, 1>;
using BallMatrix = Eigen::Matrix<Ball, 3, 3>;

/// The exact numbers of a vector of doubles.
inline BallVector exactly(const Eigen::Vector3d& v) { return {Ball(v(0)), Ball(v(1)), Ball(v(2))}; }

namespace enclosure {

// The sums are written out, because Eigen's reductions want more of a scalar than a ball can promise.
template <class A, class B>
auto dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) -> typename A::Scalar {
  typename A::Scalar sum = a(0) * b(0);
  for (Eigen::Index i = 1; i < a.size(); ++i) sum += a(i) * b(i);
  return sum;
}

template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> cross(const Eigen::Matrix<Scalar, 3, 1>& a, const Eigen::Matrix<Scalar, 3, 1>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

}  // namespace enclosure

}  // namespace irradiff
