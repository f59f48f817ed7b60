#pragma once

#include "derivatives/boundary/vector.h"

namespace irradiff {

/// W/m^2 (W/m in flatland).
template <class Scalar>
struct Irradiance {
  Scalar value;
};

/// Derivative of irradiance with respect to the receiver's position, normal and scene fixed. W/m^3 (W/m^2 in flatland).
template <class Scalar, int Dimension = 3>
struct TranslationalGradient {
  Eigen::Matrix<Scalar, Dimension, 1> value;
};

/// Derivative of irradiance with respect to a rotation vector applied to the normal: n turns into n + omega x n. W/(m^2
/// rad). To first order E at normal n_2 is E + g.(n x n_2). In flatland a single number, counterclockwise turns
/// positive, W/(m rad).
template <class Scalar, int Dimension = 3>
struct RotationalGradient {
  Eigen::Matrix<Scalar, Dimension == 3 ? 3 : 1, 1> value;
};

/// Second derivative with respect to the receiver's position, symmetric. W/m^4 (W/m^3 in flatland).
template <class Scalar, int Dimension = 3>
struct IrradianceHessian {
  Eigen::Matrix<Scalar, Dimension, Dimension> value;
};

/// The Hessian restricted to the receiver's tangent plane, in the frame of `tangentFrame(normal)`. W/m^4 (W/m^3 in
/// flatland).
template <class Scalar, int Dimension = 3>
struct TangentialHessian {
  Eigen::Matrix<Scalar, Dimension - 1, Dimension - 1> value;
};

template <class Scalar, int Dimension = 3>
struct IrradianceDerivatives {
  Irradiance<Scalar> irradiance;
  TranslationalGradient<Scalar, Dimension> gradient;
  IrradianceHessian<Scalar, Dimension> hessian;
  TangentialHessian<Scalar, Dimension> tangential_hessian;
  RotationalGradient<Scalar, Dimension> rotational_gradient;
};

/// Two orthonormal tangents (columns) of the plane with unit normal n, (t, b, n) right-handed; t is the projection of
/// the coordinate axis least aligned with n, x before y before z where they tie. For n = (0, 0, 1): t = (1, 0, 0), b =
/// (0, 1, 0). Orthonormal to rounding even where n is a unit vector to 1e-12 only.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 2> tangentFrame(const Vector3<Scalar>& normal) {
  using std::abs;
  using std::sqrt;
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (abs(normal(i)) < abs(normal(axis))) {
      axis = i;
    }
  }
  const Scalar square = dot(normal, normal);
  Vector3<Scalar> tangent = scaled(normal, Scalar(-normal(axis) / square));
  tangent(axis) = tangent(axis) + lift<Scalar>(1.0);
  tangent = scaled(tangent, Scalar(lift<Scalar>(1.0) / norm(tangent)));
  const Vector3<Scalar> bitangent = scaled(cross(normal, tangent), Scalar(lift<Scalar>(1.0) / sqrt(square)));
  Eigen::Matrix<Scalar, 3, 2> frame;
  for (int i = 0; i < 3; ++i) {
    frame(i, 0) = tangent(i);
    frame(i, 1) = bitangent(i);
  }
  return frame;
}

/// t^T H t for the tangents t of `tangentFrame(normal)`. Shape 2 x 2. Where H is much larger along the normal than in
/// the tangent plane, the result has the rounding errors of the large entries; boundarySums and areaRule add up the
/// terms of the tangent plane alone.
template <class Scalar>
TangentialHessian<Scalar> tangentialHessian(const Matrix3<Scalar>& hessian, const Vector3<Scalar>& normal) {
  const Eigen::Matrix<Scalar, 3, 2> frame = tangentFrame(normal);
  TangentialHessian<Scalar> result;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      Scalar sum = lift<Scalar>(0.0);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          sum = sum + frame(i, a) * hessian(i, j) * frame(j, b);
        }
      }
      result.value(a, b) = sum;
    }
  }
  return result;
}

}  // namespace irradiff
