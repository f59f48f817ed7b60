#pragma once

#include "derivatives/boundary/scalar.h"

#include <array>
#include <cstddef>

// The edge kernel of edge_kernel.h for a short arc given by its two ends, without an angle: no root, no division and no
// branch, so that a loop over many arcs becomes vector instructions. docs/derivations/sample_estimators.md, section 1.

namespace irradiff {

/// One end of an arc in a frame whose third axis is the receiver's normal: the components of the unit direction, and
/// what is linear in it.
template <class Scalar>
struct FrameEnd {
  Scalar t, b, n;           ///< n, the cosine, is at least 0
  Scalar inverse_distance;  ///< 1/m
};

/// What an arc with a unit radiance jump adds to the gradient (1/m) and to the Hessian (1/m^2), in that frame. The
/// Hessian is the symmetric part, all that is left of it in a sum over closed boundaries; tt, tb and bb are the
/// tangential Hessian.
template <class Scalar>
struct FrameTerms {
  Scalar t, b, n;
  Scalar tt, tb, bb, tn, bn, nn;
};

/// Integrals over the chord between the ends of an arc of length D, s in [-1/2, 1/2] from its middle and
/// rho^2 = 1 - (1 - 4 s^2) sin^2(D/2) the square of the distance between the receiver and the chord there:
///   fourth = int rho^-4 ds,  fourth_2 = int s^2 rho^-4 ds,
///   sixth = int rho^-6 ds,   sixth_2 = int s^2 rho^-6 ds,   sixth_4 = int s^4 rho^-6 ds.
/// All are positive and grow with D; at D = 0 they are 1, 1/12, 1, 1/12, 1/80.
template <class Scalar>
struct ChordMoments {
  Scalar fourth, fourth_2;
  Scalar sixth, sixth_2, sixth_4;
};

namespace detail {

inline constexpr std::size_t kChordSeriesTerms = 16;

/// Coefficients of sixth_4 as a power series in sin^2(D/2): 4^-2 (k + 1)(k + 2)/2 int_0^1 v^4 (1 - v^2)^k dv.
constexpr std::array<double, kChordSeriesTerms> chordSeries() {
  std::array<double, kChordSeriesTerms> series{};
  long double integral = 0.2L;
  for (std::size_t k = 0; k < kChordSeriesTerms; ++k) {
    if (k > 0) integral *= static_cast<long double>(2 * k) / static_cast<long double>(2 * k + 5);
    series[k] = static_cast<double>(static_cast<long double>((k + 1) * (k + 2)) * integral / 32.0L);
  }
  return series;
}

inline constexpr std::array<double, kChordSeriesTerms> kChordSeries = chordSeries();

/// A number to the powers 1, 2, 4 and 8.
template <class Scalar>
struct ChordPowers {
  Scalar first, second, fourth, eighth;
};

/// `count` terms (a power of two) of the series from term `first` on, divided by the power `first`. Halves are summed
/// by themselves: what waits for each other is short.
template <std::size_t first, std::size_t count, class Scalar>
[[gnu::always_inline]] inline Scalar chordSeriesValue(const ChordPowers<Scalar>& powers) {
  static_assert(first + count <= kChordSeriesTerms);
  if constexpr (count == 1) {
    return lift<Scalar>(kChordSeries[first]);
  } else {
    constexpr std::size_t kHalf = count / 2;
    const Scalar& power = kHalf == 1   ? powers.first
                          : kHalf == 2 ? powers.second
                          : kHalf == 4 ? powers.fourth
                                       : powers.eighth;
    return chordSeriesValue<first, kHalf>(powers) + chordSeriesValue<first + kHalf, kHalf>(powers) * power;
  }
}

}  // namespace detail

/// How long an arc may be, and the terms of the power series that leave less than u/4 of the sums: neglected is at most
/// 1/4 terms^(3/2) square^terms times what they are proportional to.
struct FewChordTerms {
  static constexpr std::size_t kTerms = 8;
  static constexpr double kHalfChordSquare = 0x1p-7;  ///< sin^2(D/2), D up to 10 degrees
};
struct ManyChordTerms {
  static constexpr std::size_t kTerms = detail::kChordSeriesTerms;
  static constexpr double kHalfChordSquare = 0x1p-4;  ///< D up to 29 degrees
};

// One series and the sums that integration by parts gives, each of positive terms: with S = sin^2(D/2)
//   fourth_2 = 1/12 + 16/3 S sixth_4,   sixth_2 = (1/12 + 4/3 S sixth_4)/(1 - S),
//   fourth = 1 + 16 S sixth_2,          sixth = (1 + 12 S sixth_2)/(1 - S).
// docs/derivations/sample_estimators.md, section 1. Requires half_chord_square in the range of `Terms`.
template <class Terms, class Scalar>
[[gnu::always_inline]] inline ChordMoments<Scalar> chordMoments(const Scalar& half_chord_square) {
  const Scalar one = lift<Scalar>(1.0);
  const Scalar twelfth = lift<Scalar>(1.0 / 12.0);
  const Scalar& square = half_chord_square;
  const Scalar square_2 = square * square;
  const Scalar square_4 = square_2 * square_2;
  const detail::ChordPowers<Scalar> powers{square, square_2, square_4, square_4 * square_4};
  // 1/(1 - S) = (1 + S)(1 + S^2)(1 + S^4)(1 + S^8) ...
  Scalar inverse = (one + square) * (one + square_2) * (one + square_4);
  if constexpr (Terms::kTerms > 8) inverse = inverse * (one + powers.eighth);
  ChordMoments<Scalar> moments;
  moments.sixth_4 = detail::chordSeriesValue<0, Terms::kTerms>(powers);
  const Scalar sum_4 = square * moments.sixth_4 * lift<Scalar>(4.0 / 3.0);
  moments.fourth_2 = twelfth + lift<Scalar>(4.0) * sum_4;
  moments.sixth_2 = (twelfth + sum_4) * inverse;
  const Scalar sum_2 = square * moments.sixth_2 * lift<Scalar>(4.0);
  moments.fourth = one + lift<Scalar>(4.0) * sum_2;
  moments.sixth = (one + lift<Scalar>(3.0) * sum_2) * inverse;
  return moments;
}

/// sin^2(D/2) of the arc between two unit directions.
template <class Scalar>
[[gnu::always_inline]] inline Scalar halfChordSquare(const FrameEnd<Scalar>& first, const FrameEnd<Scalar>& last) {
  const Scalar t = last.t - first.t;
  const Scalar b = last.b - first.b;
  const Scalar n = last.n - first.n;
  return (t * t + b * b + n * n) * lift<Scalar>(0.25);
}

// With m half the sum of the directions, d their difference, and subscripts m and d for the same of cosine and inverse
// distance:
//   (r x e) s            = (m x d) (nu_m kappa_m fourth + nu_d kappa_d fourth_2)
//   (r x e)(4 q - I n)^T = (m x d) (4 m (c_0 sixth + c_2 sixth_2) + 4 d (c_1 sixth_2 + c_3 sixth_4)
//                                   - n (kappa_m^2 fourth + kappa_d^2 fourth_2))^T
//   c_0 = nu_m kappa_m^2,                      c_1 = 2 nu_m kappa_m kappa_d + nu_d kappa_m^2,
//   c_2 = nu_m kappa_d^2 + 2 nu_d kappa_m kappa_d,  c_3 = nu_d kappa_d^2.
// Transport theorem; docs/derivations/sample_estimators.md, section 1. m x d is the product of the directions without
// its cancellation. Requires half_chord_square = halfChordSquare(first, last) within the range of `Terms`, directions
// of unit length to rounding, and an arc that is not part of the horizon: that adds nothing. Error of each entry:
// kChordArcError u times the arc's angle times the largest value on it of nu kappa (gradient) and of 4 nu kappa^2 +
// kappa^2 (Hessian; 4 nu kappa^2 for tt, tb and bb).
template <class Terms, class Scalar>
[[gnu::always_inline]] inline FrameTerms<Scalar> chordArcTerms(const FrameEnd<Scalar>& first,
                                                               const FrameEnd<Scalar>& last,
                                                               const Scalar& half_chord_square) {
  const Scalar half = lift<Scalar>(0.5);
  const Scalar two = lift<Scalar>(2.0);
  const Scalar four = lift<Scalar>(4.0);
  const Scalar mt = (first.t + last.t) * half;
  const Scalar mb = (first.b + last.b) * half;
  const Scalar nu_m = (first.n + last.n) * half;
  const Scalar kappa_m = (first.inverse_distance + last.inverse_distance) * half;
  const Scalar dt = last.t - first.t;
  const Scalar db = last.b - first.b;
  const Scalar nu_d = last.n - first.n;
  const Scalar kappa_d = last.inverse_distance - first.inverse_distance;
  const Scalar ct = mb * nu_d - nu_m * db;
  const Scalar cb = nu_m * dt - mt * nu_d;
  const Scalar cn = mt * db - mb * dt;

  const ChordMoments<Scalar> moments = chordMoments<Terms>(half_chord_square);
  const Scalar kappa_mm = kappa_m * kappa_m;
  const Scalar kappa_md = two * kappa_m * kappa_d;
  const Scalar kappa_dd = kappa_d * kappa_d;
  const Scalar weight = nu_m * kappa_m * moments.fourth + nu_d * kappa_d * moments.fourth_2;
  const Scalar even = four * (nu_m * kappa_mm * moments.sixth + (nu_m * kappa_dd + nu_d * kappa_md) * moments.sixth_2);
  const Scalar odd = four * ((nu_m * kappa_md + nu_d * kappa_mm) * moments.sixth_2 + nu_d * kappa_dd * moments.sixth_4);
  const Scalar squares = kappa_mm * moments.fourth + kappa_dd * moments.fourth_2;
  const Scalar at = even * mt + odd * dt;
  const Scalar ab = even * mb + odd * db;
  const Scalar an = even * nu_m + odd * nu_d - squares;
  return {ct * weight,
          cb * weight,
          cn * weight,
          ct * at,
          half * (ct * ab + cb * at),
          cb * ab,
          half * (ct * an + cn * at),
          half * (cb * an + cn * ab),
          cn * an};
}

}  // namespace irradiff
