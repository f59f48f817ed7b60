#pragma once

#include "derivatives/boundary/arc_moments.h"
#include "verification/certified/running_bound.h"

#include <array>
#include <cstddef>

namespace irradiff {

/// The power series of one moment in D^2 at T, and how far from the moment its rounded coefficients and its missing
/// terms may take it.
template <class T, std::size_t terms>
struct BoundedArcSeries {
  std::array<T, terms> coefficients{};
  double short_tail = 0.0;  ///< of what the first kShortTerms leave out, D^2 <= kShortSquare
  double tail = 0.0;        ///< of what all terms leave out, D^2 <= kLongestSquare
};

template <class T>
struct ArcSeriesTerms;
template <>
struct ArcSeriesTerms<double> {
  static constexpr std::size_t kTerms = 20;
  static constexpr std::size_t kShortTerms = 9;
};
template <>
struct ArcSeriesTerms<long double> {
  static constexpr std::size_t kTerms = 24;
  static constexpr std::size_t kShortTerms = 11;
};
template <>
struct ArcSeriesTerms<DoubleWord<double>> {
  static constexpr std::size_t kTerms = 40;
  static constexpr std::size_t kShortTerms = 18;
};

template <class T>
struct BoundedArcMomentSeries {
  using Series = BoundedArcSeries<T, ArcSeriesTerms<T>::kTerms>;
  Series aa, ab, aaaa, aaab, aabb;

  static constexpr double kShortSquare = 0x1p-4;
  /// A little above 1: whether D is at most 1 is decided by its rounded value.
  static constexpr double kLongestSquare = 1.0 + 0x1p-10;
  /// Of a series for D^2 <= kLongestSquare: its derivative over itself, at most; and the relative error of Horner's
  /// rule with rounded coefficients, in units of Rounding<T>::kProduct (certified_bounds.md, section 3).
  static constexpr double kSlope = 1.0;
  static constexpr double kHornerError = 8.0;
};

/// The series from coefficients that are enclosed by balls, once.
template <class T>
const BoundedArcMomentSeries<T>& boundedArcMomentSeries();
template <>
const BoundedArcMomentSeries<double>& boundedArcMomentSeries();
template <>
const BoundedArcMomentSeries<long double>& boundedArcMomentSeries();
template <>
const BoundedArcMomentSeries<DoubleWord<double>>& boundedArcMomentSeries();

template <class T>
RunningBound<T> valueOf(const typename BoundedArcMomentSeries<T>::Series& series, const RunningBound<T>& square) {
  using Bounds = BoundedArcMomentSeries<T>;
  const bool is_short = static_cast<double>(square.value()) <= Bounds::kShortSquare;
  std::size_t k = is_short ? ArcSeriesTerms<T>::kShortTerms : ArcSeriesTerms<T>::kTerms;
  T sum = series.coefficients[--k];
  while (k-- > 0) sum = sum * square.value() + series.coefficients[k];
  const double size = Rounding<T>::magnitude(sum);
  return {sum, size * (Bounds::kHornerError * Rounding<T>::kProduct + Bounds::kSlope * square.rawError()) +
                   (is_short ? series.short_tail : series.tail)};
}

/// The moments of an arc of 0 <= D <= 2 by their series: the closed forms would cancel.
template <class T>
ArcMoments<RunningBound<T>> arcMoments(const RunningBound<T>& angle) {
  if (static_cast<double>(angle.value()) > 1.0) {
    const RunningBound<T> half_angle = angle * RunningBound<T>(0.5);
    return doubled(arcMoments(half_angle), half_angle);
  }
  const RunningBound<T> square = angle * angle;
  // Beyond this the slope above is not known to hold.
  if (!(square.rawError() <= 0x1p-11)) {
    const RunningBound<T> unknown = RunningBound<T>::unbounded();
    return {unknown, unknown, unknown, unknown, unknown};
  }
  const BoundedArcMomentSeries<T>& series = boundedArcMomentSeries<T>();
  return {valueOf<T>(series.aa, square), valueOf<T>(series.ab, square), valueOf<T>(series.aaaa, square),
          valueOf<T>(series.aaab, square), valueOf<T>(series.aabb, square)};
}

}  // namespace irradiff
