#pragma once

#include "verification/variants/boundary_closed_form.h"
#include "verification/variants/gauss_rule.h"

namespace irradiff {

/// Exact to double precision for every edge: the integrands are trigonometric polynomials of degree 4 over less than
/// pi.
inline constexpr std::size_t kAngleNodes = 16;

// The integrals of an edge by Gauss-Legendre quadrature in the angle about the receiver: what short edges lose in
// differences of antiderivatives is not lost here.
template <class Scalar>
AngleIntegrals<Scalar> gaussAngleIntegrals(const EdgeInItsPlane<Scalar>& edge, const Vector3<Scalar>& normal) {
  using std::cos;
  using std::sin;
  const GaussRule<Scalar, kAngleNodes>& rule = gaussRule<Scalar, kAngleNodes>();
  const Scalar span = edge.last_angle - edge.first_angle;
  const Scalar n_foot = dot(normal, edge.to_foot);
  const Scalar n_along = dot(normal, edge.along);
  Scalar nu_cos(0);
  Scalar cos2(0);
  Scalar along_foot(0);
  Scalar along_edge(0);
  for (std::size_t k = 0; k < kAngleNodes; ++k) {
    const Scalar angle = edge.first_angle + span * rule.nodes[k];
    const Scalar c = cos(angle);
    const Scalar s = sin(angle);
    const Scalar nu = n_foot * c + n_along * s;
    const Scalar weight = span * rule.weights[k] * c;
    nu_cos += weight * nu;
    cos2 += weight * c;
    along_foot += weight * c * nu * c;
    along_edge += weight * c * nu * s;
  }
  AngleIntegrals<Scalar> integrals{nu_cos, cos2, {}};
  for (int i = 0; i < 3; ++i) integrals.nu_cos2_w(i) = along_foot * edge.to_foot(i) + along_edge * edge.along(i);
  return integrals;
}

}  // namespace irradiff
