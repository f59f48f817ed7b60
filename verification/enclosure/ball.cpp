#include "verification/enclosure/ball.h"

#include "verification/enclosure/undecided.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace irradiff {

namespace {

thread_local slong working_bits = kDefaultPrecision;

std::string take(char* text) {
  const std::unique_ptr<char, decltype(&flint_free)> owner(text, &flint_free);
  return owner.get();
}

}  // namespace

WorkingPrecision::WorkingPrecision(slong bits) : previous_(working_bits) {
  if (bits < 2) {
    throw std::invalid_argument("working precision is " + std::to_string(bits) + " bits; it must be at least 2");
  }
  working_bits = bits;
}

WorkingPrecision::~WorkingPrecision() { working_bits = previous_; }

slong WorkingPrecision::bits() { return working_bits; }

slong precisionForDigits(int digits) {
  return static_cast<slong>(std::ceil(digits * 3.3219280948873626)) + 64;  // log2(10) bits a digit
}

Ball Ball::fromDecimal(const std::string& text) {
  Ball result;
  if (arb_set_str(result.ball_, text.c_str(), working_bits) != 0) {
    throw std::invalid_argument("\"" + text + "\" is not a decimal number");
  }
  return result;
}

Ball Ball::powerOfTwo(slong exponent) {
  Ball result(1);
  arb_mul_2exp_si(result.ball_, result.ball_, exponent);
  return result;
}

Ball Ball::aroundZero(const Ball& radius) {
  Ball result;
  arb_add_error(result.ball_, radius.ball_);
  return result;
}

Ball Ball::pi() {
  Ball result;
  arb_const_pi(result.ball_, working_bits);
  return result;
}

Ball Ball::hull(const Ball& a, const Ball& b) {
  Ball result;
  arb_union(result.ball_, a.ball_, b.ball_, working_bits);
  return result;
}

Ball Ball::midpoint() const {
  Ball result;
  arb_get_mid_arb(result.ball_, ball_);
  return result;
}

Ball Ball::radius() const {
  Ball result;
  arb_get_rad_arb(result.ball_, ball_);
  return result;
}

Ball Ball::magnitude() const {
  Ball result;
  arb_get_abs_ubound_arf(arb_midref(result.ball_), ball_, working_bits);
  return result;
}

double Ball::digits() const {
  // arb_rel_accuracy_bits counts from the exponent of the midpoint, and is huge and positive for exact balls.
  const slong bits = std::clamp(arb_rel_accuracy_bits(ball_), slong{0}, slong{1} << 30);
  return static_cast<double>(bits) * 0.30102999566398120;
}

double Ball::toDouble() const { return arf_get_d(arb_midref(ball_), ARF_RND_NEAR); }

std::string Ball::midpointToDecimal(int significant_digits) const {
  return take(arb_get_str(ball_, significant_digits, ARB_STR_NO_RADIUS | ARB_STR_MORE));
}

std::string Ball::toDecimal(int significant_digits) const { return take(arb_get_str(ball_, significant_digits, 0)); }

Ball& Ball::operator+=(const Ball& b) {
  arb_add(ball_, ball_, b.ball_, working_bits);
  return *this;
}

Ball& Ball::operator-=(const Ball& b) {
  arb_sub(ball_, ball_, b.ball_, working_bits);
  return *this;
}

Ball& Ball::operator*=(const Ball& b) {
  arb_mul(ball_, ball_, b.ball_, working_bits);
  return *this;
}

Ball& Ball::operator/=(const Ball& b) {
  arb_div(ball_, ball_, b.ball_, working_bits);
  return *this;
}

Ball Ball::operator-() const {
  Ball result;
  arb_neg(result.ball_, ball_);
  return result;
}

Ball sqrt(const Ball& x) {
  Ball result;
  arb_sqrt(result.get(), x.get(), working_bits);
  return result;
}

Ball abs(const Ball& x) {
  Ball result;
  arb_abs(result.get(), x.get());
  return result;
}

Ball atan(const Ball& x) {
  Ball result;
  arb_atan(result.get(), x.get(), working_bits);
  return result;
}

Ball atan2(const Ball& y, const Ball& x) {
  Ball result;
  arb_atan2(result.get(), y.get(), x.get(), working_bits);
  return result;
}

Ball acos(const Ball& x) {
  Ball result;
  arb_acos(result.get(), x.get(), working_bits);
  return result;
}

Ball sin(const Ball& x) {
  Ball result;
  arb_sin(result.get(), x.get(), working_bits);
  return result;
}

Ball cos(const Ball& x) {
  Ball result;
  arb_cos(result.get(), x.get(), working_bits);
  return result;
}

Ball min(const Ball& a, const Ball& b) {
  Ball result;
  arb_min(result.get(), a.get(), b.get(), working_bits);
  return result;
}

Ball max(const Ball& a, const Ball& b) {
  Ball result;
  arb_max(result.get(), a.get(), b.get(), working_bits);
  return result;
}

bool isPositive(const Ball& x) {
  if (x > Ball(0)) return true;
  if (x <= Ball(0)) return false;
  throw Undecided("the sign of a ball that decides what is added up");
}

Ball withSignOf(const Ball& magnitude, const Ball& sign) {
  if (sign < Ball(0)) return -magnitude;
  if (sign >= Ball(0)) return magnitude;
  return Ball::aroundZero(magnitude);
}

}  // namespace irradiff
