#include "verification/certified/ball_rounding.h"

#include <cmath>
#include <limits>

namespace irradiff {

namespace {

Ball around(Ball midpoint, double error) {
  if (!(error < std::numeric_limits<double>::infinity())) {
    Ball unknown;
    arb_indeterminate(unknown.get());
    return unknown;
  }
  mag_t radius;
  mag_init(radius);
  mag_set_d(radius, error);
  arb_add_error_mag(midpoint.get(), radius);
  mag_clear(radius);
  return midpoint;
}

/// Of the ball's midpoint alone: the sum of two doubles needs no more bits than lie between them.
constexpr slong kExact = ARF_PREC_EXACT;

}  // namespace

double magnitudeBound(const Ball& ball) {
  if (!ball.isFinite()) return std::numeric_limits<double>::infinity();
  mag_t magnitude;
  mag_init(magnitude);
  arb_get_mag(magnitude, ball.get());
  const double bound = mag_get_d(magnitude);
  mag_clear(magnitude);
  // To nearest, of a number that is rounded upwards.
  return bound == 0.0 ? 0.0 : std::nextafter(bound, std::numeric_limits<double>::infinity());
}

template <>
RunningBound<double> rounded(const Ball& ball) {
  const double value = ball.toDouble();
  return {value, magnitudeBound(ball - Ball(value))};
}

template <>
RunningBound<long double> rounded(const Ball& ball) {
  return static_cast<RunningBound<long double>>(rounded<DoubleWord<double>>(ball));
}

template <>
RunningBound<DoubleWord<double>> rounded(const Ball& ball) {
  const double high = ball.toDouble();
  const Ball rest = ball - Ball(high);
  const double low = rest.toDouble();
  return {{high, low}, magnitudeBound(rest - Ball(low))};
}

Ball enclosureOf(const RunningBound<double>& number) { return around(Ball(number.value()), number.error()); }

Ball enclosureOf(const RunningBound<long double>& number) {
  return enclosureOf(RunningBound<DoubleWord<double>>(number));
}

Ball enclosureOf(const RunningBound<DoubleWord<double>>& number) {
  Ball sum;
  const Ball low(number.value().lo);
  arb_set_d(sum.get(), number.value().hi);
  arb_add(sum.get(), sum.get(), low.get(), kExact);
  return around(sum, number.error());
}

}  // namespace irradiff
