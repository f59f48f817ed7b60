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

/// fraction 2^exponent; exponents beyond an int are those of numbers beyond every range.
long double scaledByPower(double fraction, const fmpz_t exponent) {
  constexpr slong kFarBeyond = 1 << 20;
  const slong clamped = fmpz_cmp_si(exponent, kFarBeyond) > 0    ? kFarBeyond
                        : fmpz_cmp_si(exponent, -kFarBeyond) < 0 ? -kFarBeyond
                                                                 : fmpz_get_si(exponent);
  return std::ldexp(static_cast<long double>(fraction), static_cast<int>(clamped));
}

/// Of a ball that is exact and not negative.
long double upperBound(const Ball& ball) {
  const long double nearest = midpointInLongDouble(ball);
  return ball == Ball(0) ? 0.0L
                         : std::nextafter(nearest * (1.0L + 0x1p-50L), std::numeric_limits<long double>::infinity());
}

/// Of the ball's midpoint alone: the sum of two doubles needs no more bits than lie between them.
constexpr slong kExact = ARF_PREC_EXACT;

}  // namespace

long double midpointInLongDouble(const Ball& ball) {
  arf_t fraction;
  fmpz_t exponent;
  arf_init(fraction);
  fmpz_init(exponent);
  arf_frexp(fraction, exponent, arb_midref(ball.get()));
  const long double value = scaledByPower(arf_get_d(fraction, ARF_RND_NEAR), exponent);
  fmpz_clear(exponent);
  arf_clear(fraction);
  return value;
}

double magnitudeBound(const Ball& ball) {
  if (!ball.isFinite()) return std::numeric_limits<double>::infinity();
  // (mag_get_d would give 2^-1000 for all that is smaller.)
  const Ball magnitude = ball.magnitude();
  const auto bound = static_cast<double>(upperBound(magnitude));
  return magnitude == Ball(0) ? 0.0 : std::nextafter(bound, std::numeric_limits<double>::infinity());
}

long double radiusInLongDouble(const Ball& ball) { return upperBound(ball.radius()); }

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
