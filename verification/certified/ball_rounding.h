#pragma once

#include "verification/certified/running_bound.h"
#include "verification/enclosure/ball.h"

namespace irradiff {

/// A double that is at least every |x| of the ball; infinity where the ball has no bound.
double magnitudeBound(const Ball& ball);

/// The midpoint and an upper bound of the radius, in a range where the bounds of small doubles do not vanish. Require a
/// finite ball.
long double midpointInLongDouble(const Ball& ball);
long double radiusInLongDouble(const Ball& ball);

/// The ball's midpoint rounded to T, with a bound of the distance to everything in the ball.
template <class T>
RunningBound<T> rounded(const Ball& ball);
template <>
RunningBound<double> rounded(const Ball& ball);
template <>
RunningBound<long double> rounded(const Ball& ball);
template <>
RunningBound<DoubleWord<double>> rounded(const Ball& ball);

/// An upper bound of a size that terms were added up to.
template <class T>
double sizeOf(const RunningBound<T>& size) {
  return static_cast<double>(size.value()) + size.error();
}
inline double sizeOf(const Ball& size) { return magnitudeBound(size); }

/// Everything within the bound.
Ball enclosureOf(const RunningBound<double>& number);
Ball enclosureOf(const RunningBound<long double>& number);
Ball enclosureOf(const RunningBound<DoubleWord<double>>& number);

}  // namespace irradiff
