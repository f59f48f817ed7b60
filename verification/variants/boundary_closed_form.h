#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/form_factor/form_factor.h"
#include "derivatives/form_factor/pi.h"

#include <cmath>
#include <span>

namespace irradiff {

/// An edge of a polygon as the receiver sees it, in the frame of its own plane.
template <class Scalar>
struct EdgeInItsPlane {
  Vector3<Scalar> plane_normal;    ///< unit, along r x e
  Vector3<Scalar> along;           ///< unit, along e
  Vector3<Scalar> to_foot;         ///< unit, to the point of the edge's line nearest to the receiver
  Scalar inverse_distance;         ///< of that point; 1/m
  Scalar first_angle, last_angle;  ///< from the foot, in (-pi/2, pi/2)

  EdgeInItsPlane(const Vector3<Scalar>& r, const Vector3<Scalar>& r_next, const Vector3<Scalar>& e) {
    using std::atan2;
    const Scalar one = lift<Scalar>(1.0);
    const Vector3<Scalar> moment = cross(r, e);
    const Scalar area = norm(moment);
    const Scalar length = norm(e);
    plane_normal = scaled(moment, Scalar(one / area));
    along = scaled(e, Scalar(one / length));
    to_foot = cross(along, plane_normal);
    const Scalar distance = area / length;
    inverse_distance = one / distance;
    first_angle = atan2(dot(r, along), distance);
    last_angle = atan2(dot(r_next, along), distance);
  }
};

/// What an edge needs of the integrals over its angle a, with w(a) = f cos a + (e/|e|) sin a and nu = n.w.
template <class Scalar>
struct AngleIntegrals {
  Scalar nu_cos;              ///< int nu cos a da
  Scalar cos2;                ///< int cos^2 a da
  Vector3<Scalar> nu_cos2_w;  ///< int nu cos^2 a w da
};

// Adds what an edge contributes to 2 pi F, pi grad F and pi hess F:
//   Gamma,   (m/d) int nu cos a da,   (1/d^2) { int nu cos a da [e/|e|]_x + m (4 int nu cos^2 a w da - n int cos^2 a
//   da)^T }
// docs/derivations/radiance_boundary.md, with d the distance from the receiver to the edge's line and m the normal of
// the arc's plane. Requires |n| = 1.
template <class Scalar>
void addEdge(const EdgeInItsPlane<Scalar>& edge, const AngleIntegrals<Scalar>& integrals, const Vector3<Scalar>& normal,
             FormFactor<Scalar>& sum) {
  const Scalar k = edge.inverse_distance;
  sum.value += dot(normal, edge.plane_normal) * (edge.last_angle - edge.first_angle);
  const Vector3<Scalar> u = scaled(edge.along, Scalar(k * k * integrals.nu_cos));
  sum.gradient += scaled(edge.plane_normal, Scalar(k * integrals.nu_cos));
  const Vector3<Scalar> row =
      scaled(difference(scaled(integrals.nu_cos2_w, Scalar(4)), scaled(normal, integrals.cos2)), Scalar(k * k));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sum.hessian(i, j) += edge.plane_normal(i) * row(j);
  }
  sum.hessian(0, 1) -= u(2);
  sum.hessian(0, 2) += u(1);
  sum.hessian(1, 0) += u(2);
  sum.hessian(1, 2) -= u(0);
  sum.hessian(2, 0) -= u(1);
  sum.hessian(2, 1) += u(0);
}

/// The sum over the edges of a polygon, the integrals of each by `integrate(edge, normal)`. Vertices and position in
/// metres, all above the receiver's horizon, clockwise seen from it for F > 0. Units 1, 1/m, 1/m^2.
template <class Scalar, class Integrate>
FormFactor<Scalar> sumOverEdges(std::span<const Vector3<Scalar>> vertices, const Vector3<Scalar>& position,
                                const Vector3<Scalar>& normal, const Integrate& integrate) {
  FormFactor<Scalar> sum{Scalar(0), Vector3<Scalar>::Zero(), Matrix3<Scalar>::Zero()};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector3<Scalar>& a = vertices[i];
    const Vector3<Scalar>& b = vertices[i + 1 < vertices.size() ? i + 1 : 0];
    // The edge from the vertices as they are stored: no rounding of the receiver's distance gets into it.
    const EdgeInItsPlane<Scalar> edge(difference(a, position), difference(b, position), difference(b, a));
    addEdge(edge, integrate(edge, normal), normal, sum);
  }
  const Scalar inverse_pi = Scalar(1) / pi<Scalar>();
  FormFactor<Scalar> result{sum.value * inverse_pi / Scalar(2), scaled(sum.gradient, inverse_pi), sum.hessian};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.hessian(i, j) = (sum.hessian(i, j) + sum.hessian(j, i)) * inverse_pi / Scalar(2);
  }
  return result;
}

// The integrals by their antiderivatives, the plain way: differences of angles, sines and powers of cosines at the two
// ends. They cancel where the edge is short: the third power of the angle is what is left of the first.
template <class Scalar>
AngleIntegrals<Scalar> closedAngleIntegrals(const EdgeInItsPlane<Scalar>& edge, const Vector3<Scalar>& normal) {
  using std::cos;
  using std::sin;
  const Scalar a0 = edge.first_angle;
  const Scalar a1 = edge.last_angle;
  const Scalar s0 = sin(a0);
  const Scalar s1 = sin(a1);
  const Scalar c0 = cos(a0);
  const Scalar c1 = cos(a1);
  const Scalar half(0.5);
  const Scalar quarter(0.25);
  const Scalar cos2 = half * (a1 - a0 + s1 * c1 - s0 * c0);
  const Scalar sin_cos = half * (c0 * c0 - c1 * c1);
  const Scalar cos3_sin = quarter * (c0 * c0 * c0 * c0 - c1 * c1 * c1 * c1);
  const Scalar cos4 = quarter * (c1 * c1 * c1 * s1 - c0 * c0 * c0 * s0 + Scalar(3) * cos2);
  const Scalar cos2_sin2 = cos2 - cos4;
  const Scalar n_foot = dot(normal, edge.to_foot);
  const Scalar n_along = dot(normal, edge.along);
  const Scalar along_foot = n_foot * cos4 + n_along * cos3_sin;
  const Scalar along_edge = n_foot * cos3_sin + n_along * cos2_sin2;
  AngleIntegrals<Scalar> integrals;
  integrals.nu_cos = n_foot * cos2 + n_along * sin_cos;
  integrals.cos2 = cos2;
  for (int i = 0; i < 3; ++i) integrals.nu_cos2_w(i) = along_foot * edge.to_foot(i) + along_edge * edge.along(i);
  return integrals;
}

}  // namespace irradiff
