#pragma once

#include "derivatives/boundary/horizon_height.h"
#include "derivatives/boundary/irradiance.h"

#include <span>
#include <utility>

namespace irradiff {

/// A quarter turn counterclockwise.
template <class Scalar>
Vector2<Scalar> quarterTurn(const Vector2<Scalar>& v) {
  return {-v(1), v(0)};
}

/// r0 x r1: positive when r1 is counterclockwise of r0.
template <class Scalar>
Scalar cross(const Vector2<Scalar>& a, const Vector2<Scalar>& b) {
  return a(0) * b(1) - a(1) * b(0);
}

/// Irradiance of one flatland segment of radiance 1 and its derivatives, with the sizes that rounding errors are
/// proportional to.
template <class Scalar>
struct SegmentSums {
  IrradianceDerivatives<Scalar, 2> derivatives;
  Scalar irradiance_size;
  Scalar gradient_size;
  Scalar hessian_size;
  Scalar tangential_size;
  Scalar rotational_size;
};

/// The part of a segment above the receiver's horizon, relative to the receiver, `last` counterclockwise of `first`.
template <class Scalar>
struct ClippedSegment {
  Vector2<Wide<Scalar>> first, last;
  Scalar first_height, last_height;  ///< n.r, exactly 0 where cut at the horizon
  bool crosses_horizon = false;
  bool is_visible = false;  ///< something rises above the horizon and is not seen end-on
};

/// r0 x r1 = r x (r1 - r0), r being the nearer of the two: the difference, rounded, may have nothing left of it.
template <class Scalar, class WideScalar>
WideScalar crossFromNearer(const Vector2<WideScalar>& r0, const Vector2<WideScalar>& r1) {
  const bool is_first_nearer = norm(narrow<Scalar>(r0)) <= norm(narrow<Scalar>(r1));
  return cross(is_first_nearer ? r0 : r1, Vector2<WideScalar>(difference(r1, r0)));
}

template <class Scalar>
ClippedSegment<Scalar> clipSegment(const Vector2<Scalar>& a, const Vector2<Scalar>& b, const Vector2<Scalar>& position,
                                   const Vector2<Scalar>& normal) {
  using WideScalar = Wide<Scalar>;
  const Scalar zero = lift<Scalar>(0.0);
  Vector2<WideScalar> r0 = wideDifference<WideScalar>(a, position);
  Vector2<WideScalar> r1 = wideDifference<WideScalar>(b, position);
  const Scalar side = static_cast<Scalar>(crossFromNearer<Scalar>(r0, r1));
  if (side < zero) {
    std::swap(r0, r1);
  }
  const WideScalar wide_h0 = horizonHeight<WideScalar>(side < zero ? b : a, position, normal);
  const WideScalar wide_h1 = horizonHeight<WideScalar>(side < zero ? a : b, position, normal);
  ClippedSegment<Scalar> clipped{r0, r1, static_cast<Scalar>(wide_h0), static_cast<Scalar>(wide_h1)};
  const bool below0 = clipped.first_height < zero;
  const bool below1 = clipped.last_height < zero;
  clipped.crosses_horizon = below0 || below1;
  clipped.is_visible = (clipped.first_height > zero || clipped.last_height > zero) && (side < zero || side > zero);
  if (clipped.is_visible && clipped.crosses_horizon) {
    // A mean of both ends with positive weights: however far one of them is, nothing cancels but what is across.
    const Vector2<WideScalar>& seen = below0 ? r1 : r0;
    const Vector2<WideScalar>& hidden = below0 ? r0 : r1;
    const WideScalar& seen_height = below0 ? wide_h1 : wide_h0;
    const WideScalar& hidden_height = below0 ? wide_h0 : wide_h1;
    const WideScalar sum = seen_height - hidden_height;
    Vector2<WideScalar> crossing;
    for (int i = 0; i < 2; ++i) {
      crossing(i) = (seen_height * hidden(i) - hidden_height * seen(i)) / sum;
    }
    (below0 ? clipped.first : clipped.last) = crossing;
    (below0 ? clipped.first_height : clipped.last_height) = zero;
  }
  return clipped;
}

/// What doubled precision leaves of a component that cancels, in units of u times the vector's length or more.
inline constexpr double kWideSlack = 0x1p-53;

/// The component (J n).r along the horizon. In the wider scalar: it cancels where r is along the normal.
template <class Scalar>
Scalar alongTangent(const Vector2<Wide<Scalar>>& r, const Vector2<Scalar>& normal) {
  return static_cast<Scalar>(dot(widen<Wide<Scalar>>(quarterTurn(normal)), r));
}

/// Irradiance and rotational gradient, from the unit directions of the ends and the tangent of half the angle between
/// them:
///   E = int n.w dphi = (n.w0 + n.w1) tan(angle/2),  V = int w dphi = (w0 + w1) tan(angle/2),  dE/dalpha = (J n).V
/// Every term of E is positive: relative error of a few u, whatever the segment's size. The rotational
/// gradient vanishes where the segment is straight ahead; its terms do not cancel but in that.
template <class Scalar>
void addSegmentIrradiance(const ClippedSegment<Scalar>& segment, const Vector2<Scalar>& normal,
                          SegmentSums<Scalar>& sums) {
  using std::abs;
  const Vector2<Scalar> r0 = narrow<Scalar>(segment.first);
  const Vector2<Scalar> r1 = narrow<Scalar>(segment.last);
  const Vector2<Wide<Scalar>> edge = difference(segment.last, segment.first);
  const Scalar l0 = norm(r0);
  const Scalar l1 = norm(r1);
  const Scalar area = static_cast<Scalar>(cross(l0 <= l1 ? segment.first : segment.last, edge));
  const Scalar cosine_product = dot(r0, r1);
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar half_tangent =
      cosine_product > zero ? Scalar(area / (l0 * l1 + cosine_product)) : Scalar((l0 * l1 - cosine_product) / area);
  const Scalar nu0 = segment.first_height / l0;
  const Scalar nu1 = segment.last_height / l1;
  const Scalar tau0 = alongTangent<Scalar>(segment.first, normal) / l0;
  const Scalar tau1 = alongTangent<Scalar>(segment.last, normal) / l1;
  const Scalar irradiance = (nu0 + nu1) * half_tangent;
  sums.derivatives.irradiance.value = irradiance;
  sums.irradiance_size = irradiance;
  const Scalar spread = abs(tau0 - tau1);
  if (tau0 * tau1 < zero && nu0 + nu1 < spread) {
    // Ends low on both sides of the normal. With nu^2 + tau^2 = |n|^2 at both,
    //   tau0 + tau1 = (nu1 - nu0) (nu0 + nu1) / (tau0 - tau1).
    sums.derivatives.rotational_gradient.value(0) = irradiance * ((nu1 - nu0) / (tau0 - tau1));
    sums.rotational_size = irradiance * ((nu0 + nu1) / spread);
  } else {
    sums.derivatives.rotational_gradient.value(0) = (tau0 + tau1) * half_tangent;
    sums.rotational_size = (abs(tau0) + abs(tau1) + lift<Scalar>(2.0 * kWideSlack)) * half_tangent;
  }
}

// Flatland irradiance of one segment of radiance 1, its gradient and its Hessian, from the two boundary points:
//   G(r) = (n.r) J r / |r|^3,  grad E = G(r_first) - G(r_last),  hess E = dG/dr(r_last) - dG/dr(r_first)
//   tangential Hessian T.(dG/dr T) = -3 (n.r)^2 (T.r) / |r|^5 at each end, T = J n
// with J a quarter turn counterclockwise and r relative to the receiver; where the segment is cut at the horizon G is
// and stays 0. docs/derivations/flatland.md. Units W/m, W/m^2, W/m^3. A difference of the ends: segments small compared
// with their distance use the quadrature in segment_evaluation.cpp.
template <class Scalar>
SegmentSums<Scalar> segmentBoundaryForm(const ClippedSegment<Scalar>& segment, const Vector2<Scalar>& normal) {
  SegmentSums<Scalar> sums;
  addSegmentIrradiance(segment, normal, sums);
  using std::abs;
  const Scalar zero = lift<Scalar>(0.0);
  const Scalar one = lift<Scalar>(1.0);
  const Scalar three = lift<Scalar>(3.0);
  sums.derivatives.gradient.value = Vector2<Scalar>::Constant(zero);
  sums.derivatives.hessian.value = Matrix2<Scalar>::Constant(zero);
  sums.derivatives.tangential_hessian.value(0, 0) = zero;
  sums.gradient_size = zero;
  sums.hessian_size = zero;
  sums.tangential_size = zero;
  const Scalar inverse_square = one / dot(normal, normal);
  const auto add = [&](const Vector2<Wide<Scalar>>& position, const Scalar& height, const Scalar& sign) {
    if (!isPositive(height)) {
      return;
    }
    const Vector2<Scalar> r = narrow<Scalar>(position);
    const Scalar kappa = one / norm(r);
    const Vector2<Scalar> w = scaled(r, kappa);
    const Vector2<Scalar> side = quarterTurn(w);
    const Scalar nu = height * kappa;
    sums.gradient_size = sums.gradient_size + nu * kappa;
    sums.hessian_size = sums.hessian_size + (one + three * nu) * kappa * kappa;
    const Scalar tau = alongTangent<Scalar>(position, normal) * kappa;
    const Scalar curvature = three * nu * nu * tau * kappa * kappa * inverse_square;
    Scalar& tangential = sums.derivatives.tangential_hessian.value(0, 0);
    tangential = tangential - sign * curvature;
    const Scalar tau_size = abs(tau) + lift<Scalar>(kWideSlack);
    sums.tangential_size = sums.tangential_size + three * nu * nu * tau_size * kappa * kappa * inverse_square;
    for (int i = 0; i < 2; ++i) {
      sums.derivatives.gradient.value(i) = sums.derivatives.gradient.value(i) - sign * nu * kappa * side(i);
      for (int j = 0; j < 2; ++j) {
        const Scalar turn = i == j ? zero : (i == 0 ? Scalar(-nu) : nu);
        const Scalar slope = side(i) * normal(j) + turn - three * nu * side(i) * w(j);
        sums.derivatives.hessian.value(i, j) = sums.derivatives.hessian.value(i, j) + sign * slope * kappa * kappa;
      }
    }
  };
  add(segment.first, segment.first_height, Scalar(-one));
  add(segment.last, segment.last_height, one);
  const Scalar off_diagonal =
      lift<Scalar>(0.5) * (sums.derivatives.hessian.value(0, 1) + sums.derivatives.hessian.value(1, 0));
  sums.derivatives.hessian.value(0, 1) = off_diagonal;
  sums.derivatives.hessian.value(1, 0) = off_diagonal;
  return sums;
}

}  // namespace irradiff
