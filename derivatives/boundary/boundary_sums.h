#pragma once

#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/boundary/irradiance.h"

namespace irradiff {

/// Sums over the arcs of a boundary together with the sizes that rounding errors are proportional to.
template <class Scalar>
struct BoundarySums {
  IrradianceDerivatives<Scalar> derivatives;
  Scalar irradiance_size;
  Scalar gradient_size;
  Scalar hessian_size;
};

// Irradiance, its gradients and its Hessian from the radiance boundary:
//   E      = 1/2 sum dL n.Gamma, arcs of the horizon included
//   grad E = sum dL (r x e) s
//   hess E = sum dL { s [e]_x + (r x e)(4 q - I n)^T }, symmetrised: the antisymmetric part of the sum is zero
//   rotational gradient = n x V, V = 1/2 sum dL Gamma the vector irradiance (the horizon's part of V is parallel to n)
// docs/derivations/radiance_boundary.md. Requires |n| = 1 and arcs above the horizon.
template <class Scalar>
BoundarySums<Scalar> boundarySums(const RadianceBoundary<Scalar>& boundary, const Vector3<Scalar>& normal) {
  using std::abs;
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar half = lift<Scalar>(0.5);
  Vector3<Scalar> vector_irradiance = Vector3<Scalar>::Constant(zero);
  Vector3<Scalar> gradient = vector_irradiance;
  Matrix3<Scalar> hessian = Matrix3<Scalar>::Constant(zero);
  Scalar irradiance_size = boundary.horizon_size * half;
  Scalar gradient_size = zero;
  Scalar hessian_size = zero;
  for (const BoundaryArc<Scalar>& arc : boundary.arcs) {
    const ArcTerms<Scalar> terms = arcTerms(arc, normal);
    const Scalar& jump = arc.radiance_jump;
    const Scalar jump_size = abs(jump);
    for (int i = 0; i < 3; ++i) {
      vector_irradiance(i) = vector_irradiance(i) + jump * half * terms.angle_vector(i);
      gradient(i) = gradient(i) + jump * terms.gradient(i);
      for (int j = 0; j < 3; ++j) {
        hessian(i, j) = hessian(i, j) + jump * terms.hessian(i, j);
      }
    }
    irradiance_size = irradiance_size + jump_size * half * arc.angle;
    gradient_size = gradient_size + jump_size * terms.gradient_size;
    hessian_size = hessian_size + jump_size * terms.hessian_size;
  }
  Matrix3<Scalar> symmetric;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      symmetric(i, j) = half * (hessian(i, j) + hessian(j, i));
    }
  }
  const Scalar irradiance = dot(normal, vector_irradiance) + half * boundary.horizon_angle;
  return {{{irradiance}, {gradient}, {symmetric}, {cross(normal, vector_irradiance)}},
          irradiance_size,
          gradient_size,
          hessian_size};
}

}  // namespace irradiff
