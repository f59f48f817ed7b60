#include "verification/certified/arc_moment_bounds.h"

#include "verification/certified/ball_rounding.h"

namespace irradiff {

namespace {

constexpr slong kSeriesBits = 512;

template <std::size_t terms>
Ball partialSum(const detail::ArcSeries<Ball, terms>& series, std::size_t count, const Ball& square) {
  Ball sum = series[--count];
  while (count-- > 0) sum = sum * square + series[count];
  return sum;
}

/// Of one moment, from its exact coefficients and its values at the largest angles that the two lengths serve. All
/// coefficients are positive: what is left out grows with D, and so does the sum of the coefficients' roundings.
template <class T>
typename BoundedArcMomentSeries<T>::Series boundedSeries(
    const detail::ArcSeries<Ball, ArcSeriesTerms<T>::kTerms>& exact, const Ball& short_value, const Ball& value) {
  typename BoundedArcMomentSeries<T>::Series series;
  for (std::size_t k = 0; k < exact.size(); ++k) series.coefficients[k] = rounded<T>(exact[k]).value();
  using Bounds = BoundedArcMomentSeries<T>;
  series.short_tail =
      magnitudeBound(short_value - partialSum(exact, ArcSeriesTerms<T>::kShortTerms, Ball(Bounds::kShortSquare)));
  series.tail = magnitudeBound(value - partialSum(exact, exact.size(), Ball(Bounds::kLongestSquare)));
  return series;
}

template <class T>
BoundedArcMomentSeries<T> makeSeries() {
  const WorkingPrecision precision(kSeriesBits);
  using Bounds = BoundedArcMomentSeries<T>;
  const auto exact = detail::arcMomentSeries<Ball, ArcSeriesTerms<T>::kTerms>();
  const ArcMoments<Ball> shorter = arcMoments(sqrt(Ball(Bounds::kShortSquare)));
  const ArcMoments<Ball> longest = arcMoments(sqrt(Ball(Bounds::kLongestSquare)));
  return {boundedSeries<T>(exact.aa, shorter.aa, longest.aa), boundedSeries<T>(exact.ab, shorter.ab, longest.ab),
          boundedSeries<T>(exact.aaaa, shorter.aaaa, longest.aaaa),
          boundedSeries<T>(exact.aaab, shorter.aaab, longest.aaab),
          boundedSeries<T>(exact.aabb, shorter.aabb, longest.aabb)};
}

}  // namespace

template <>
const BoundedArcMomentSeries<double>& boundedArcMomentSeries() {
  static const BoundedArcMomentSeries<double> series = makeSeries<double>();
  return series;
}

template <>
const BoundedArcMomentSeries<long double>& boundedArcMomentSeries() {
  static const BoundedArcMomentSeries<long double> series = makeSeries<long double>();
  return series;
}

template <>
const BoundedArcMomentSeries<DoubleWord<double>>& boundedArcMomentSeries() {
  static const BoundedArcMomentSeries<DoubleWord<double>> series = makeSeries<DoubleWord<double>>();
  return series;
}

}  // namespace irradiff
