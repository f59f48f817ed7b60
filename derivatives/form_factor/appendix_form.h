#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/form_factor/form_factor.h"
#include "derivatives/form_factor/pi.h"

#include <cstddef>
#include <span>

namespace irradiff {

/// How the angle between two vertices is found; the paper leaves it open.
enum class VertexAngle {
  kArccos,  ///< acos of the dot product of the unit vectors, as a renderer would write it: absolute error sqrt(u) at
            ///< small angles
  kArctangent,  ///< atan2(|r x r'|, r.r'): relative error of a few u at every angle
};

/// The integrals along an edge p(t) = r + t e, t in [0, 1], of Appendix A of [Schwarzhaupt et al. 2012]:
///   I_k = int |p|^-2k dt,  J_k = int t |p|^-2k dt,  K_k = int t^2 |p|^-2k dt.
/// Units 1/m^2 (index 1), 1/m^4 (index 2), 1/m^6 (index 3).
template <class Scalar>
struct AppendixIntegrals {
  Scalar I1, I2, I3;
  Scalar J2, J3;
  Scalar K3;
};

template <class Scalar>
Scalar vertexAngle(const Vector3<Scalar>& r, const Vector3<Scalar>& r_next, VertexAngle formula) {
  using std::acos;
  using std::atan2;
  if (formula == VertexAngle::kArccos) {
    return acos(dot(r, r_next) / (norm(r) * norm(r_next)));
  }
  return atan2(norm(cross(r, r_next)), dot(r, r_next));
}

// The closed forms below Eq. (21), as printed. gamma in I1 is the angle between the vertices (docs/errata.md).
// Requires that the receiver is not on the edge's line: all divide by |e x r|^2. Their errors grow as u (|r|/|e|)^3 for
// short edges.
template <class Scalar>
AppendixIntegrals<Scalar> appendixIntegrals(const Vector3<Scalar>& r, const Vector3<Scalar>& r_next,
                                            VertexAngle formula) {
  const Vector3<Scalar> e = difference(r_next, r);
  const Vector3<Scalar> e_cross_r = cross(e, r);
  const Scalar one = lift<Scalar>(1.0);
  const Scalar area2 = dot(e_cross_r, e_cross_r);
  const Scalar ee = dot(e, e);
  const Scalar er = dot(e, r);
  const Scalar er_next = dot(e, r_next);
  const Scalar rr = dot(r, r);
  const Scalar rr_next = dot(r_next, r_next);
  AppendixIntegrals<Scalar> integrals;
  integrals.I1 = vertexAngle(r, r_next, formula) / norm(e_cross_r);
  integrals.I2 = (er_next / rr_next - er / rr + ee * integrals.I1) / (lift<Scalar>(2.0) * area2);
  integrals.I3 = (er_next / (rr_next * rr_next) - er / (rr * rr) + lift<Scalar>(3.0) * ee * integrals.I2) /
                 (lift<Scalar>(4.0) * area2);
  integrals.J2 = (one / rr - one / rr_next) / (lift<Scalar>(2.0) * ee) - er / ee * integrals.I2;
  integrals.J3 = (one / (rr * rr) - one / (rr_next * rr_next)) / (lift<Scalar>(4.0) * ee) - er / ee * integrals.I3;
  integrals.K3 = (integrals.I2 - rr * integrals.I3 - lift<Scalar>(2.0) * er * integrals.J3) / ee;
  return integrals;
}

/// Q(a, b) = a b^T + b a^T.
template <class Scalar>
Matrix3<Scalar> symmetricProduct(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  Matrix3<Scalar> q;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      q(i, j) = a(i) * b(j) + b(i) * a(j);
    }
  }
  return q;
}

// Form factor, gradient and Hessian in the appendix form of [Schwarzhaupt et al. 2012] after [Holzschuch and Sillion
// 1998]:
//   F = 1/(2 pi) n.sum Gamma_i                                                                Eq. (19), |Gamma_i| =
//   gamma_i the angle grad F = 1/(2 pi) sum { n x e I1 + 2 n.(r x r') (r I2 + e J2) }                           Eq.
//   (20), overall sign corrected hess F = 1/pi sum { Q(n x e, r I2 + e J2) - n.(r x e) I2 1
//                       + 2 n.(r x e)(Q(r, r) I3 + Q(e, e) K3 + 2 J3 Q(r, e)) }               Eq. (21), overall sign
//                       corrected
// The corrections and their measured residuals are in docs/errata.md.
// Vertices relative to the receiver, in metres, all above its horizon, clockwise seen from it for F > 0. Units 1, 1/m,
// 1/m^2. Error: unbounded for short, near-radial and near edges; the report shows it. Kept as the field's point of
// comparison.
template <class Scalar>
FormFactor<Scalar> appendixFormFactor(std::span<const Vector3<Scalar>> relative_vertices, const Vector3<Scalar>& normal,
                                      VertexAngle formula) {
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar two = lift<Scalar>(2.0);
  FormFactor<Scalar> sum{zero, Vector3<Scalar>::Constant(zero), Matrix3<Scalar>::Constant(zero)};
  for (std::size_t i = 0; i < relative_vertices.size(); ++i) {
    const Vector3<Scalar>& r = relative_vertices[i];
    const Vector3<Scalar>& r_next = relative_vertices[(i + 1) % relative_vertices.size()];
    const Vector3<Scalar> e = difference(r_next, r);
    const Vector3<Scalar> r_cross = cross(r, r_next);
    const Scalar n_r_cross = dot(normal, r_cross);
    const Vector3<Scalar> n_cross_e = cross(normal, e);
    const auto [I1, I2, I3, J2, J3, K3] = appendixIntegrals(r, r_next, formula);
    const Vector3<Scalar> weighted = scaled(r, I2) + scaled(e, J2);
    const Matrix3<Scalar> q_line = symmetricProduct(n_cross_e, weighted);
    const Matrix3<Scalar> q_rr = symmetricProduct(r, r);
    const Matrix3<Scalar> q_ee = symmetricProduct(e, e);
    const Matrix3<Scalar> q_re = symmetricProduct(r, e);
    sum.value = sum.value + n_r_cross * I1;
    for (int a = 0; a < 3; ++a) {
      sum.gradient(a) = sum.gradient(a) + n_cross_e(a) * I1 + two * n_r_cross * weighted(a);
      for (int b = 0; b < 3; ++b) {
        sum.hessian(a, b) = sum.hessian(a, b) + q_line(a, b) +
                            two * n_r_cross * (q_rr(a, b) * I3 + q_ee(a, b) * K3 + two * J3 * q_re(a, b));
      }
      sum.hessian(a, a) = sum.hessian(a, a) - n_r_cross * I2;
    }
  }
  const Scalar inverse_pi = lift<Scalar>(1.0) / pi<Scalar>();
  const Scalar inverse_two_pi = inverse_pi * lift<Scalar>(0.5);
  FormFactor<Scalar> result{sum.value * inverse_two_pi, scaled(sum.gradient, inverse_two_pi), sum.hessian};
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      result.hessian(a, b) = result.hessian(a, b) * inverse_pi;
    }
  }
  return result;
}

}  // namespace irradiff
