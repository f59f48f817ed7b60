#pragma once

#include "derivatives/boundary/scalar.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace irradiff {

/// Means over an arc of length D of products of the two endpoint weights
///   a(phi) = sin(D - phi) / sin D,   b(phi) = sin(phi) / sin D,
/// with which every vector of the arc's plane that is linear in direction is interpolated from its values at the ends:
///   aa = mean of a^2 = mean of b^2,   ab = mean of a b,
///   aaaa = mean of a^4 = mean of b^4, aaab = mean of a^3 b = mean of a b^3, aabb = mean of a^2 b^2.
/// All are positive and grow with D; at D = 0 they are 1/3, 1/6, 1/5, 1/20, 1/30.
/// docs/derivations/radiance_boundary.md, section 4.
template <class Scalar>
struct ArcMoments {
  Scalar aa, ab;
  Scalar aaaa, aaab, aabb;
};

namespace detail {

/// Power series in D^2.
template <class Number, std::size_t terms>
using ArcSeries = std::array<Number, terms>;

template <class Number, std::size_t terms>
constexpr ArcSeries<Number, terms> seriesProduct(const ArcSeries<Number, terms>& a, const ArcSeries<Number, terms>& b) {
  ArcSeries<Number, terms> c{};
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t j = 0; i + j < terms; ++j) {
      c[i + j] += a[i] * b[j];
    }
  }
  return c;
}

template <class Number, std::size_t terms>
constexpr ArcSeries<Number, terms> seriesQuotient(const ArcSeries<Number, terms>& a,
                                                  const ArcSeries<Number, terms>& b) {
  ArcSeries<Number, terms> c{};
  for (std::size_t k = 0; k < terms; ++k) {
    Number rest = a[k];
    for (std::size_t j = 1; j <= k; ++j) {
      rest -= b[j] * c[k - j];
    }
    c[k] = rest / b[0];
  }
  return c;
}

template <class Number, std::size_t terms>
constexpr ArcSeries<Number, terms> seriesSum(const ArcSeries<Number, terms>& a, double factor,
                                             const ArcSeries<Number, terms>& b) {
  ArcSeries<Number, terms> c{};
  for (std::size_t k = 0; k < terms; ++k) {
    c[k] = a[k] + Number(factor) * b[k];
  }
  return c;
}

/// Coefficients of (-1)^shift (sin(w D)/(w D) - its first `shift` terms) / D^(2 shift); with shift 0, sin(w D)/(w D)
/// itself.
template <class Number, std::size_t terms>
constexpr ArcSeries<Number, terms> sineRatioTail(double frequency, std::size_t shift) {
  ArcSeries<Number, terms> c{};
  Number term(1.0);
  for (std::size_t k = 0; k < terms + shift; ++k) {
    if (k > 0) {
      term *= Number(-frequency * frequency) / Number(static_cast<double>((2 * k) * (2 * k + 1)));
    }
    if (k >= shift) {
      c[k - shift] = shift % 2 == 0 ? Number(term) : Number(-term);
    }
  }
  return c;
}

template <class Number, std::size_t terms>
constexpr ArcSeries<Number, terms> cosineSeries() {
  ArcSeries<Number, terms> c{};
  Number term(1.0);
  for (std::size_t k = 0; k < terms; ++k) {
    if (k > 0) {
      term *= Number(-1.0) / Number(static_cast<double>((2 * k - 1) * (2 * k)));
    }
    c[k] = term;
  }
  return c;
}

template <class Number, std::size_t terms>
struct ArcMomentSeries {
  ArcSeries<Number, terms> aa{}, ab{}, aaaa{}, aaab{}, aabb{};
};

/// All coefficients are positive (docs/derivations/certified_bounds.md, section 3).
template <class Number, std::size_t terms>
constexpr ArcMomentSeries<Number, terms> arcMomentSeries() {
  using Series = ArcSeries<Number, terms>;
  // The closed forms below, divided by the powers of D that they share.
  const Series zero{};
  const Series sine = sineRatioTail<Number, terms>(1.0, 0);
  const Series cosine = cosineSeries<Number, terms>();
  const Series sine2 = seriesProduct(sine, sine);
  const Series sine4 = seriesProduct(sine2, sine2);
  const Series sine5 = seriesProduct(sine4, sine);

  Series sine_minus_cosine{};  // (sin D / D - cos D) / D^2
  Number factorial_term(1.0);
  for (std::size_t k = 1; k <= terms; ++k) {
    factorial_term *= Number(-1.0) / Number(static_cast<double>((2 * k) * (2 * k + 1)));
    sine_minus_cosine[k - 1] = -factorial_term * Number(static_cast<double>(2 * k));
  }
  const Series aa = seriesSum(zero, 0.5, sineRatioTail<Number, terms>(2.0, 1));
  const Series ab = seriesSum(zero, 0.5, sine_minus_cosine);
  const Series aaaa = seriesSum(seriesSum(zero, -0.5, sineRatioTail<Number, terms>(2.0, 2)), 0.125,
                                sineRatioTail<Number, terms>(4.0, 2));
  const Series aaab = seriesSum(seriesSum(zero, 0.25, sine5), -1.0, seriesProduct(cosine, aaaa));
  const Series aabb =
      seriesSum(seriesSum(seriesSum(zero, 0.125, seriesProduct(sine2, sineRatioTail<Number, terms>(4.0, 1))), -0.5,
                          seriesProduct(sine5, cosine)),
                1.0, seriesProduct(seriesProduct(cosine, cosine), aaaa));
  return {seriesQuotient(aa, sine2), seriesQuotient(ab, sine2), seriesQuotient(aaaa, sine4),
          seriesQuotient(aaab, sine4), seriesQuotient(aabb, sine4)};
}

/// For machine numbers: evaluated at compile time in long double.
inline constexpr std::size_t kArcSeriesTerms = 20;
/// Terms that suffice for D <= 1/4: (D/pi)^18 < 2^-64.
inline constexpr std::size_t kShortArcSeriesTerms = 9;
inline constexpr ArcMomentSeries<long double, kArcSeriesTerms> kArcMomentSeries =
    arcMomentSeries<long double, kArcSeriesTerms>();

template <class Scalar>
Scalar seriesValue(const ArcSeries<long double, kArcSeriesTerms>& series, std::size_t terms, const Scalar& argument) {
  Scalar sum = lift<Scalar>(static_cast<double>(series[terms - 1]));
  if constexpr (std::is_same_v<Scalar, long double>) {
    sum = series[terms - 1];
  }
  for (std::size_t k = terms - 1; k-- > 0;) {
    if constexpr (std::is_same_v<Scalar, long double>) {
      sum = sum * argument + series[k];
    } else {
      sum = sum * argument + lift<Scalar>(static_cast<double>(series[k]));
    }
  }
  return sum;
}

}  // namespace detail

/// The moments of an arc from those of its half: each half is an arc of its own whose middle direction is c (first +
/// last), c = 1/(2 cos(half angle)). Only positive terms; an arc of more than a radian would lose digits in the closed
/// forms.
template <class Scalar>
ArcMoments<Scalar> doubled(const ArcMoments<Scalar>& half, const Scalar& half_angle) {
  using std::cos;
  const Scalar c = lift<Scalar>(1.0) / (lift<Scalar>(2.0) * cos(half_angle));
  const Scalar c2 = c * c;
  const Scalar c3 = c2 * c;
  const Scalar c4 = c2 * c2;
  const Scalar one_half = lift<Scalar>(0.5);
  const Scalar two = lift<Scalar>(2.0);
  const Scalar three = lift<Scalar>(3.0);
  const Scalar four = lift<Scalar>(4.0);
  const Scalar six = lift<Scalar>(6.0);
  const Scalar& h3 = half.aaab;
  const Scalar& h22 = half.aabb;
  return {half.aa * one_half + c * half.ab + c2 * half.aa, c * half.ab + c2 * half.aa,
          (half.aaaa + four * c * h3 + six * c2 * h22 + four * c3 * h3) * one_half + c4 * half.aaaa,
          (c * h3 + three * c2 * h22 + three * c3 * h3 + c3 * h3) * one_half + c4 * half.aaaa,
          c2 * (h22 + two * c * h3 + c2 * half.aaaa)};
}

/// The moments of an arc of `angle` radians, 0 <= angle <= 2 (longer arcs are cut at the foot of the perpendicular
/// first). Relative error for machine numbers: at most 3.5 u up to a radian and 17.3 u above
/// (docs/derivations/error_bounds.md, section 2.3). Numbers of chosen precision use the closed forms, which lose 5
/// log10(1/angle) digits: choose the precision accordingly.
template <class Scalar>
ArcMoments<Scalar> arcMoments(const Scalar& angle) {
  using std::cos;
  using std::sin;
  if constexpr (kIsMachinePrecision<Scalar>) {
    if (angle > lift<Scalar>(1.0)) {
      const Scalar half_angle = angle * lift<Scalar>(0.5);
      return doubled(arcMoments(half_angle), half_angle);
    }
    const Scalar square = angle * angle;
    const std::size_t terms = square <= lift<Scalar>(0.0625) ? detail::kShortArcSeriesTerms : detail::kArcSeriesTerms;
    const auto& series = detail::kArcMomentSeries;
    return {detail::seriesValue(series.aa, terms, square), detail::seriesValue(series.ab, terms, square),
            detail::seriesValue(series.aaaa, terms, square), detail::seriesValue(series.aaab, terms, square),
            detail::seriesValue(series.aabb, terms, square)};
  } else {
    if (angle <= lift<Scalar>(0.0)) {
      const Scalar one = lift<Scalar>(1.0);
      return {one / lift<Scalar>(3.0), one / lift<Scalar>(6.0), one / lift<Scalar>(5.0), one / lift<Scalar>(20.0),
              one / lift<Scalar>(30.0)};
    }
    const Scalar s = sin(angle);
    const Scalar c = cos(angle);
    const Scalar s2 = s * s;
    const Scalar s4 = s2 * s2;
    const Scalar sin_to_4 =
        (lift<Scalar>(3.0) * (angle - s * c) - lift<Scalar>(2.0) * s2 * s * c) * lift<Scalar>(0.125);
    const Scalar sin_cos_squared = (angle - s * c * (lift<Scalar>(1.0) - lift<Scalar>(2.0) * s2)) * lift<Scalar>(0.125);
    return {(angle - s * c) * lift<Scalar>(0.5) / (s2 * angle), (s - angle * c) * lift<Scalar>(0.5) / (s2 * angle),
            sin_to_4 / (s4 * angle), (s4 * s * lift<Scalar>(0.25) - c * sin_to_4) / (s4 * angle),
            (s2 * sin_cos_squared - s4 * s * c * lift<Scalar>(0.5) + c * c * sin_to_4) / (s4 * angle)};
  }
}

}  // namespace irradiff
