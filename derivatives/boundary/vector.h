#pragma once

#include "derivatives/boundary/scalar.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace irradiff {

// Eigen's dot, norm and cast do not accept nested automatic-differentiation numbers, so formulas that run at every
// scalar use these.

template <class Scalar>
using Vector2 = Eigen::Matrix<Scalar, 2, 1>;
template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Matrix2 = Eigen::Matrix<Scalar, 2, 2>;
template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

template <class Scalar, int Dimension>
Scalar dot(const Eigen::Matrix<Scalar, Dimension, 1>& a, const Eigen::Matrix<Scalar, Dimension, 1>& b) {
  Scalar sum = a(0) * b(0);
  for (int i = 1; i < Dimension; ++i) {
    sum = sum + a(i) * b(i);
  }
  return sum;
}

template <class Scalar>
Vector3<Scalar> cross(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

template <class Scalar, int Dimension>
Scalar norm(const Eigen::Matrix<Scalar, Dimension, 1>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

template <class Scalar, int Dimension>
Eigen::Matrix<Scalar, Dimension, 1> scaled(const Eigen::Matrix<Scalar, Dimension, 1>& a, const Scalar& factor) {
  Eigen::Matrix<Scalar, Dimension, 1> result;
  for (int i = 0; i < Dimension; ++i) {
    result(i) = a(i) * factor;
  }
  return result;
}

template <class Scalar, int Dimension>
Eigen::Matrix<Scalar, Dimension, 1> difference(const Eigen::Matrix<Scalar, Dimension, 1>& a,
                                               const Eigen::Matrix<Scalar, Dimension, 1>& b) {
  Eigen::Matrix<Scalar, Dimension, 1> result;
  for (int i = 0; i < Dimension; ++i) {
    result(i) = a(i) - b(i);
  }
  return result;
}

/// Componentwise a - b in the wider scalar.
template <class WideScalar, class Scalar, int Dimension>
Eigen::Matrix<WideScalar, Dimension, 1> wideDifference(const Eigen::Matrix<Scalar, Dimension, 1>& a,
                                                       const Eigen::Matrix<Scalar, Dimension, 1>& b) {
  Eigen::Matrix<WideScalar, Dimension, 1> result;
  for (int i = 0; i < Dimension; ++i) {
    result(i) = wideDifference<WideScalar, Scalar>(a(i), b(i));
  }
  return result;
}

/// The wider vector rounded to Scalar.
template <class Scalar, class WideScalar, int Dimension>
Eigen::Matrix<Scalar, Dimension, 1> narrow(const Eigen::Matrix<WideScalar, Dimension, 1>& a) {
  Eigen::Matrix<Scalar, Dimension, 1> result;
  for (int i = 0; i < Dimension; ++i) {
    result(i) = static_cast<Scalar>(a(i));
  }
  return result;
}

template <class WideScalar, class Scalar, int Dimension>
Eigen::Matrix<WideScalar, Dimension, 1> widen(const Eigen::Matrix<Scalar, Dimension, 1>& a) {
  Eigen::Matrix<WideScalar, Dimension, 1> result;
  for (int i = 0; i < Dimension; ++i) {
    result(i) = WideScalar(a(i));
  }
  return result;
}

}  // namespace irradiff
