#pragma once

#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/boundary/tangent_plane.h"

namespace irradiff {

/// Sums over the arcs of a boundary together with the sizes that rounding errors are proportional to.
template <class Scalar>
struct BoundarySums {
  IrradianceDerivatives<Scalar> derivatives;
  Scalar irradiance_size;
  Scalar gradient_size;
  Scalar hessian_size;
  Scalar tangential_size;
  Scalar rotational_size;
  /// The same for the errors of doubled precision, where those are not negligible beside the sizes above.
  Scalar tangential_wide_size;
  Scalar rotational_wide_size;
};

// Irradiance, its gradients and its Hessian from the radiance boundary:
//   E      = 1/2 sum dL n.Gamma, arcs of the horizon included
//   grad E = sum dL (r x e) s
//   hess E = sum dL { s [e]_x + (r x e)(4 q - I n)^T }, symmetrised: the antisymmetric part of the sum is zero
//   t_a.(hess E t_b) = the symmetric part of sum dL 4 (t_a.(r x e)) (q.t_b) for tangents of the receiver's plane
//   rotational gradient = n x V = 1/2 sum dL n x Gamma, V the vector irradiance (the horizon's part of V is parallel to
//   n)
// The last two are added up from n x (r x e), not taken from V and the Hessian: near a plane that the receiver faces
// away from, V is almost along n and the Hessian's entry along n by far the largest.
// docs/derivations/radiance_boundary.md. Requires |n| = 1 and arcs above the horizon.
template <class Scalar>
BoundarySums<Scalar> boundarySums(const RadianceBoundary<Scalar>& boundary, const Vector3<Scalar>& normal) {
  using std::abs;
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar half = lift<Scalar>(0.5);
  Vector3<Scalar> vector_irradiance = Vector3<Scalar>::Constant(zero);
  Vector3<Scalar> gradient = vector_irradiance;
  Matrix3<Scalar> hessian = Matrix3<Scalar>::Constant(zero);
  const TangentPlane<Scalar> plane(normal);
  Vector3<Scalar> rotational = vector_irradiance;
  Matrix2<Scalar> tangential = Matrix2<Scalar>::Constant(zero);
  Scalar irradiance_size = boundary.horizon_size * half;
  Scalar gradient_size = zero;
  Scalar hessian_size = zero;
  Scalar tangential_size = zero;
  Scalar rotational_size = zero;
  Scalar tangential_wide_size = zero;
  Scalar rotational_wide_size = zero;
  for (const BoundaryArc<Scalar>& arc : boundary.arcs) {
    const ArcTerms<Scalar> terms = arcTerms(arc, normal);
    const Scalar& jump = arc.radiance_jump;
    const Scalar jump_size = abs(jump);
    for (int i = 0; i < 3; ++i) {
      vector_irradiance(i) = vector_irradiance(i) + jump * half * terms.angle_vector(i);
      rotational(i) = rotational(i) + jump * half * terms.turned_angle_vector(i);
      gradient(i) = gradient(i) + jump * terms.gradient(i);
      for (int j = 0; j < 3; ++j) {
        hessian(i, j) = hessian(i, j) + jump * terms.hessian(i, j);
      }
    }
    const Vector2<Scalar> across = plane.components(terms.turned_angle_vector);
    const Vector2<Scalar> along = plane.projection(terms.along_line);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        tangential(a, b) = tangential(a, b) + jump * half * (across(a) * along(b) + across(b) * along(a));
      }
    }
    irradiance_size = irradiance_size + jump_size * half * arc.angle;
    gradient_size = gradient_size + jump_size * terms.gradient_size;
    hessian_size = hessian_size + jump_size * terms.hessian_size;
    tangential_size = tangential_size + jump_size * terms.tangential_size;
    rotational_size = rotational_size + jump_size * half * terms.turned_size;
    tangential_wide_size = tangential_wide_size + jump_size * terms.tangential_wide_size;
    rotational_wide_size = rotational_wide_size + jump_size * half * terms.turned_wide_size;
  }
  Matrix3<Scalar> symmetric;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      symmetric(i, j) = half * (hessian(i, j) + hessian(j, i));
    }
  }
  const Scalar irradiance = dot(normal, vector_irradiance) + half * boundary.horizon_angle;
  return {{{irradiance}, {gradient}, {symmetric}, {tangential}, {rotational}},
          irradiance_size,
          gradient_size,
          hessian_size,
          tangential_size,
          rotational_size,
          tangential_wide_size,
          rotational_wide_size};
}

}  // namespace irradiff
