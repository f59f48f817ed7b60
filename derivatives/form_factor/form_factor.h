#pragma once

#include "derivatives/boundary/vector.h"

namespace irradiff {

/// Form factor from a differential receiver to a polygon, and its derivatives with respect to the receiver's position.
/// E = pi L F for a polygon of radiance L.
template <class Scalar>
struct FormFactor {
  Scalar value;              ///< dimensionless; positive when the vertices run clockwise seen from the receiver
  Vector3<Scalar> gradient;  ///< 1/m
  Matrix3<Scalar> hessian;   ///< 1/m^2, symmetric
};

}  // namespace irradiff
