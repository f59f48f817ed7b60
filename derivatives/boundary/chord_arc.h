#pragma once

#include "derivatives/boundary/scalar.h"

#include <array>
#include <cstddef>

// The edge kernel of edge_kernel.h for a short arc given by its two ends, without an angle: no root, no division and no
// branch, so that a loop over many arcs becomes vector instructions. docs/derivations/sample_estimators.md, "Short
// arcs".

namespace irradiff {

/// One end of an arc in a frame whose third axis is the receiver's normal: the components of the unit direction, and
/// what is linear in it.
template <class Scalar>
struct FrameEnd {
  Scalar t, b, n;           ///< n, the cosine, is at least 0
  Scalar inverse_distance;  ///< 1/m
};

/// What an arc adds to the gradient (W/m^3) and to the Hessian (W/m^4), in that frame. Of the Hessian it is the
/// symmetric part, all that is left in a sum over closed boundaries; tt, tb and bb are the tangential Hessian.
template <class Scalar>
struct FrameTerms {
  Scalar t, b, n;
  Scalar tt, bb, nn;
  Scalar tb, tn, bn;  ///< each the sum of an entry and its mirror image
};

/// Means over the chord between the ends of an arc of length D, v in [-1, 1] along it from its middle and
/// rho^2 = 1 - (1 - v^2) sin^2(D/2) the square of the distance between the receiver and the chord there:
///   fourth = <rho^-4>,  fourth_2 = <v^2 rho^-4>,
///   sixth = <rho^-6>,   sixth_2 = <v^2 rho^-6>,   sixth_4 = <v^4 rho^-6>.
/// All are positive and grow with D; at D = 0 they are 1, 1/3, 1, 1/3, 1/5.
template <class Scalar>
struct ChordMoments {
  Scalar fourth, fourth_2;
  Scalar sixth, sixth_2, sixth_4;
};

namespace detail {

inline constexpr std::size_t kChordSeriesTerms = 16;

/// Coefficients of sixth_4 as a power series in sin^2(D/2): (k + 1)(k + 2)/2 int_0^1 v^4 (1 - v^2)^k dv.
constexpr std::array<double, kChordSeriesTerms> chordSeries() {
  std::array<double, kChordSeriesTerms> series{};
  long double integral = 0.2L;
  for (std::size_t k = 0; k < kChordSeriesTerms; ++k) {
    if (k > 0) integral *= static_cast<long double>(2 * k) / static_cast<long double>(2 * k + 5);
    series[k] = static_cast<double>(static_cast<long double>((k + 1) * (k + 2)) * integral / 2.0L);
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

/// How long an arc may be, and how many terms of the series that takes: the coefficients fall from 1/5 on, so what is
/// left out of sixth_4 is less than sin^2(D/2)^terms/4. In all, less than u/4 of the sums (chord_arc_test.cpp).
struct FewChordTerms {
  static constexpr std::size_t kTerms = 8;
  static constexpr double kHalfChordSquare = 0x1p-7;  ///< sin^2(D/2), D up to 10 degrees
};
struct ManyChordTerms {
  static constexpr std::size_t kTerms = detail::kChordSeriesTerms;
  static constexpr double kHalfChordSquare = 0x1p-4;  ///< D up to 29 degrees
};

// One series and the sums that integration by parts gives, each of positive terms: with S = sin^2(D/2)
//   fourth_2 = 1/3 + 4/3 S sixth_4,   sixth_2 = (1/3 + 1/3 S sixth_4)/(1 - S),
//   fourth = 1 + 4 S sixth_2,         sixth = (1 + 3 S sixth_2)/(1 - S).
// docs/derivations/sample_estimators.md, "Short arcs". Requires half_chord_square in the range of `Terms`.
template <class Terms, class Scalar>
[[gnu::always_inline]] inline ChordMoments<Scalar> chordMoments(const Scalar& half_chord_square) {
  const Scalar one = lift<Scalar>(1.0);
  const Scalar third = lift<Scalar>(1.0 / 3.0);
  const Scalar& square = half_chord_square;
  const Scalar square_2 = square * square;
  const Scalar square_4 = square_2 * square_2;
  const detail::ChordPowers<Scalar> powers{square, square_2, square_4, square_4 * square_4};
  // 1/(1 - S) = (1 + S)(1 + S^2)(1 + S^4)(1 + S^8) ...
  Scalar inverse = (one + square) * (one + square_2) * (one + square_4);
  if constexpr (Terms::kTerms > 8) inverse = inverse * (one + powers.eighth);
  ChordMoments<Scalar> moments;
  moments.sixth_4 = detail::chordSeriesValue<0, Terms::kTerms>(powers);
  const Scalar sum_4 = square * moments.sixth_4 * third;
  moments.fourth_2 = third + lift<Scalar>(4.0) * sum_4;
  moments.sixth_2 = (third + sum_4) * inverse;
  const Scalar sum_2 = square * moments.sixth_2;
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

// With S the sum of the two directions and D their difference, and subscripts s and d for the same of cosine and
// inverse distance:
//   (r x e) s            = 1/8 (S x D) (nu_s kappa_s fourth + nu_d kappa_d fourth_2)
//   (r x e)(4 q - I n)^T = 1/8 (S x D) (S (c_0 sixth + c_2 sixth_2) + D (c_1 sixth_2 + c_3 sixth_4)
//                                       - n (kappa_s^2 fourth + kappa_d^2 fourth_2))^T
//   c_0 = nu_s kappa_s^2,                           c_1 = 2 nu_s kappa_s kappa_d + nu_d kappa_s^2,
//   c_2 = nu_s kappa_d^2 + 2 nu_d kappa_s kappa_d,  c_3 = nu_d kappa_d^2.
// Transport theorem; docs/derivations/sample_estimators.md, "Short arcs". S x D is twice the product of the directions,
// without its cancellation. Requires half_chord_square = halfChordSquare(first, last) within the range of `Terms`,
// directions of unit length to rounding, and an arc that is not part of the horizon: that adds nothing.
// Error of each entry: kChordArcError u times the radiance jump, the arc's angle and the mean over it of nu kappa
// (gradient), of 4 nu kappa^2 (a + b) (tt, tb, bb; a and b the weights of ArcMoments) or of 4 nu kappa^2 (a + b) +
// kappa^2 (tn, bn, nn).
template <class Terms, class Scalar>
[[gnu::always_inline]] inline FrameTerms<Scalar> chordArcTerms(const FrameEnd<Scalar>& first,
                                                               const FrameEnd<Scalar>& last,
                                                               const Scalar& half_chord_square,
                                                               const Scalar& radiance_jump) {
  const Scalar two = lift<Scalar>(2.0);
  const Scalar scale = radiance_jump * lift<Scalar>(0.125);
  const Scalar st = first.t + last.t;
  const Scalar sb = first.b + last.b;
  const Scalar nu_s = first.n + last.n;
  const Scalar kappa_s = first.inverse_distance + last.inverse_distance;
  const Scalar dt = last.t - first.t;
  const Scalar db = last.b - first.b;
  const Scalar nu_d = last.n - first.n;
  const Scalar kappa_d = last.inverse_distance - first.inverse_distance;
  const Scalar ct = scale * (sb * nu_d - nu_s * db);
  const Scalar cb = scale * (nu_s * dt - st * nu_d);
  const Scalar cn = scale * (st * db - sb * dt);

  const ChordMoments<Scalar> moments = chordMoments<Terms>(half_chord_square);
  const Scalar kappa_ss = kappa_s * kappa_s;
  const Scalar kappa_sd = two * kappa_s * kappa_d;
  const Scalar kappa_dd = kappa_d * kappa_d;
  const Scalar weight = nu_s * kappa_s * moments.fourth + nu_d * kappa_d * moments.fourth_2;
  const Scalar even = nu_s * kappa_ss * moments.sixth + (nu_s * kappa_dd + nu_d * kappa_sd) * moments.sixth_2;
  const Scalar odd = (nu_s * kappa_sd + nu_d * kappa_ss) * moments.sixth_2 + nu_d * kappa_dd * moments.sixth_4;
  const Scalar squares = kappa_ss * moments.fourth + kappa_dd * moments.fourth_2;
  const Scalar at = even * st + odd * dt;
  const Scalar ab = even * sb + odd * db;
  const Scalar an = even * nu_s + odd * nu_d - squares;
  return {ct * weight, cb * weight,       cn * weight,       ct * at,          cb * ab,
          cn * an,     ct * ab + cb * at, ct * an + cn * at, cb * an + cn * ab};
}

/// In units of u: the count of roundings in tests/boundary/chord_arc_test.cpp.
inline constexpr double kChordArcError = 24.0;

}  // namespace irradiff
