#pragma once

#include "derivatives/boundary/arc_moments.h"
#include "derivatives/boundary/radiance_boundary.h"

namespace irradiff {

/// What one arc with a unit radiance jump adds, and the size of the terms it was added up from: rounding errors are
/// proportional to those sizes (docs/derivations/error_bounds.md).
template <class Scalar>
struct ArcTerms {
  Vector3<Scalar> angle_vector;         ///< Gamma: along r x e, its length the arc's angle
  Vector3<Scalar> gradient;             ///< (r x e) s
  Matrix3<Scalar> hessian;              ///< s [e]_x + (r x e)(4 q - I n)^T, not symmetric arc by arc
  Vector3<Scalar> turned_angle_vector;  ///< n x Gamma
  Vector3<Scalar> along_line;           ///< 4 q |r x e|/angle: the Hessian in the tangent plane is Gamma times this
  Scalar gradient_size;
  Scalar hessian_size;
  Scalar turned_size;      ///< |n x Gamma|
  Scalar tangential_size;  ///< |n x Gamma| times the size of along_line
  /// What the errors of doubled precision in n x Gamma are proportional to (error_bounds.md, section 2.9), and that
  /// times the size of along_line.
  Scalar turned_wide_size;
  Scalar tangential_wide_size;
};

// The edge kernel: what an arc with radiance jump 1 adds to the gradient and the Hessian of irradiance.
//   (r x e) s           = m int nu kappa dphi                s = int (n.p)/|p|^4 dt
//   s [e]_x             = (1/d) int nu kappa dphi [e/|e|]_x
//   (r x e) (4q - I n)^T = m (4 int nu kappa^2 w dphi - n int kappa^2 dphi)^T
// with phi the angle along the arc, w the direction, nu = n.w, kappa = 1/|p|, m the unit normal of the arc's plane and
// d the distance from x to the edge's line. nu, kappa and w are combinations of their values at the ends with the
// weights of ArcMoments. Transport theorem; docs/derivations/radiance_boundary.md, sections 2 to 4. Units: angle_vector
// rad, gradient 1/m, hessian 1/m^2. Error of each entry: kArcError u times the size. Requires |n| = 1.
template <class Scalar>
ArcTerms<Scalar> arcTerms(const BoundaryArc<Scalar>& arc, const Vector3<Scalar>& normal) {
  using std::abs;
  const ArcMoments<Scalar> mean = arcMoments(arc.angle);
  const Scalar& nu0 = arc.first.cosine;
  const Scalar& nu1 = arc.last.cosine;
  const Scalar& kappa0 = arc.first.inverse_distance;
  const Scalar& kappa1 = arc.last.inverse_distance;
  const Scalar two = lift<Scalar>(2.0);
  const Scalar four = lift<Scalar>(4.0);

  // Products of the linear functions as polynomials in the two weights: c0 a^3 + c1 a^2 b + c2 a b^2 + c3 b^3 = nu
  // kappa^2.
  const Scalar kappa00 = kappa0 * kappa0;
  const Scalar kappa01 = two * kappa0 * kappa1;
  const Scalar kappa11 = kappa1 * kappa1;
  const Scalar c0 = nu0 * kappa00;
  const Scalar c1 = nu0 * kappa01 + nu1 * kappa00;
  const Scalar c2 = nu0 * kappa11 + nu1 * kappa01;
  const Scalar c3 = nu1 * kappa11;

  const Scalar mean_nu_kappa = (nu0 * kappa0 + nu1 * kappa1) * mean.aa + (nu0 * kappa1 + nu1 * kappa0) * mean.ab;
  const Scalar mean_kappa2 = (kappa00 + kappa11) * mean.aa + kappa01 * mean.ab;
  const Scalar along_first = c0 * mean.aaaa + c1 * mean.aaab + c2 * mean.aabb + c3 * mean.aaab;
  const Scalar along_last = c0 * mean.aaab + c1 * mean.aabb + c2 * mean.aaab + c3 * mean.aaaa;

  const Scalar line_weight = arc.angle_over_foot_distance * mean_nu_kappa;
  ArcTerms<Scalar> terms;
  terms.angle_vector = scaled(arc.plane_normal, arc.angle);
  terms.gradient_size = arc.angle * mean_nu_kappa;
  terms.gradient = scaled(arc.plane_normal, terms.gradient_size);
  const Vector3<Scalar>& e = arc.edge_direction;
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar e0 = e(0) * line_weight;
  const Scalar e1 = e(1) * line_weight;
  const Scalar e2 = e(2) * line_weight;
  terms.hessian << zero, -e2, e1, e2, zero, -e0, -e1, e0, zero;
  for (int j = 0; j < 3; ++j) {
    terms.along_line(j) = four * (along_first * arc.first.direction(j) + along_last * arc.last.direction(j));
    const Scalar row = arc.angle * (terms.along_line(j) - mean_kappa2 * normal(j));
    for (int i = 0; i < 3; ++i) {
      terms.hessian(i, j) = terms.hessian(i, j) + arc.plane_normal(i) * row;
    }
  }
  const Scalar along_line_size = four * (along_first + along_last);
  terms.hessian_size = line_weight + arc.angle * (along_line_size + mean_kappa2);
  terms.turned_angle_vector = scaled(arc.turned_plane_normal, arc.angle);
  terms.turned_size = norm(terms.turned_angle_vector);
  terms.tangential_size = terms.turned_size * along_line_size;
  terms.turned_wide_size = arc.angle_over_foot_distance * arc.cancellation_distance;
  terms.tangential_wide_size = terms.turned_wide_size * along_line_size;
  return terms;
}

/// Relative error of the gradient and Hessian terms of one arc in units of u times their size: the count of roundings
/// in docs/derivations/error_bounds.md, sections 2.5 to 2.7.
inline constexpr double kArcError = 64.0;

/// The same for an arc's share of irradiance (sections 2.4 and 2.6 there) and of the rotational gradient (2.9).
inline constexpr double kAngleError = 20.0;

/// The same for an arc's share of the tangential Hessian (section 2.9 there).
inline constexpr double kTangentialError = 96.0;

}  // namespace irradiff
