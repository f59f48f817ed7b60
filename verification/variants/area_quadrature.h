#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/form_factor/form_factor.h"
#include "derivatives/form_factor/pi.h"
#include "verification/variants/gauss_rule.h"

#include <span>

namespace irradiff {

/// Nodes in each direction of a triangle: the error is that of double where the polygon is a tenth of its distance.
inline constexpr std::size_t kAreaNodes = 8;

// The defining integral and its kernel's derivatives under the integral sign,
//   F = 1/pi int (n.p)(N.p)/|p|^4 dA,
// by tensor Gauss-Legendre quadrature on the fan of triangles from the first vertex. Nothing cancels; the error of the
// quadrature grows without limit where the polygon is not small compared with its distance. Vertices and position in
// metres, all above the receiver's horizon, clockwise seen from it for F > 0. Units 1, 1/m, 1/m^2.
template <class Scalar>
FormFactor<Scalar> areaQuadrature(std::span<const Vector3<Scalar>> vertices, const Vector3<Scalar>& position,
                                  const Vector3<Scalar>& normal) {
  const GaussRule<Scalar, kAreaNodes>& rule = gaussRule<Scalar, kAreaNodes>();
  FormFactor<Scalar> sum{Scalar(0), Vector3<Scalar>::Zero(), Matrix3<Scalar>::Zero()};
  const Vector3<Scalar> pa = difference(vertices[0], position);
  for (std::size_t t = 1; t + 1 < vertices.size(); ++t) {
    const Vector3<Scalar> ab = difference(vertices[t], vertices[0]);
    const Vector3<Scalar> bc = difference(vertices[t + 1], vertices[t]);
    const Vector3<Scalar> area = cross(ab, bc);
    const Scalar offset = dot(area, pa);
    for (std::size_t i = 0; i < kAreaNodes; ++i) {
      const Scalar s = rule.nodes[i];
      for (std::size_t j = 0; j < kAreaNodes; ++j) {
        // (s, t) -> a + s (ab + t bc) covers the triangle with Jacobian s |area|.
        const Vector3<Scalar> p = pa + s * (ab + rule.nodes[j] * bc);
        const Scalar inverse_square = Scalar(1) / dot(p, p);
        const Scalar weight = rule.weights[i] * rule.weights[j] * s * inverse_square * inverse_square;
        const Scalar height = dot(normal, p);
        const Scalar kernel = height * offset;
        const Vector3<Scalar> slope = offset * normal + height * area;
        const Vector3<Scalar> w = inverse_square * p;
        sum.value += weight * kernel;
        sum.gradient += weight * (Scalar(4) * kernel * w - slope);
        for (int a = 0; a < 3; ++a) {
          for (int b = 0; b <= a; ++b) {
            sum.hessian(a, b) +=
                weight * (normal(a) * area(b) + area(a) * normal(b) - Scalar(4) * (slope(a) * w(b) + w(a) * slope(b)) +
                          Scalar(24) * kernel * w(a) * w(b));
          }
          sum.hessian(a, a) -= weight * Scalar(4) * kernel * inverse_square;
        }
      }
    }
  }
  const Scalar inverse_pi = Scalar(1) / pi<Scalar>();
  FormFactor<Scalar> result{sum.value * inverse_pi, scaled(sum.gradient, inverse_pi), sum.hessian};
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b <= a; ++b) {
      result.hessian(a, b) = sum.hessian(a, b) * inverse_pi;
      result.hessian(b, a) = result.hessian(a, b);
    }
  }
  return result;
}

}  // namespace irradiff
