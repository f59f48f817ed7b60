#pragma once

#include <Eigen/Core>
#include <arb.h>

#include <string>

namespace irradiff {

/// Sets the precision, in bits, that every Ball and ComplexBall operation of this thread rounds to, until it is
/// destroyed. A thread starts at kDefaultPrecision. Balls made at another precision remain valid: precision belongs to
/// operations.
class WorkingPrecision {
 public:
  /// Precondition: bits >= 2.
  explicit WorkingPrecision(slong bits);
  ~WorkingPrecision();
  WorkingPrecision(const WorkingPrecision&) = delete;
  WorkingPrecision& operator=(const WorkingPrecision&) = delete;

  static slong bits();

 private:
  slong previous_;
};

inline constexpr slong kDefaultPrecision = 256;

/// Bits that hold `digits` decimal digits, with 64 bits to spare for the rounding of intermediate results.
slong precisionForDigits(int digits);

/// A real number known to lie in [midpoint - radius, midpoint + radius] (Arb). Every operation returns a ball that
/// contains the result for every choice of arguments inside theirs; where there is none (division by a ball that
/// contains zero, the root of a ball that contains a negative number) the result is not finite, which isFinite() tells.
///
/// Comparisons are certain: `a < b` says that it holds for every pair of numbers, so `a < b` and `a >= b` may both be
/// false; likewise `a == b` (both exact and equal) and `a != b` (the balls do not meet).
class Ball {
 public:
  Ball() { arb_init(ball_); }
  Ball(const Ball& other) : Ball() { arb_set(ball_, other.ball_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(ball_, other.ball_); }
  Ball& operator=(const Ball& other) {
    arb_set(ball_, other.ball_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(ball_, other.ball_);
    return *this;
  }
  ~Ball() { arb_clear(ball_); }

  /// The number itself, not a neighbourhood of it. NaN gives a ball that is not finite.
  Ball(double exact) : Ball() { arb_set_d(ball_, exact); }  // NOLINT: a double is a scalar wherever a Ball is one
  Ball(int exact) : Ball() { arb_set_si(ball_, exact); }    // NOLINT: likewise

  /// A decimal such as "1.25e-3" or, with its error, "1.25e-3 +/- 1e-9". Throws std::invalid_argument naming the text.
  static Ball fromDecimal(const std::string& text);
  /// 2^exponent.
  static Ball powerOfTwo(slong exponent);
  /// [-|radius|, |radius|].
  static Ball aroundZero(const Ball& radius);
  static Ball pi();
  /// The smallest ball that contains both.
  static Ball hull(const Ball& a, const Ball& b);

  const arb_struct* get() const { return ball_; }
  arb_struct* get() { return ball_; }

  bool isFinite() const { return arb_is_finite(ball_) != 0; }
  bool isExact() const { return arb_is_exact(ball_) != 0; }
  bool containsZero() const { return arb_contains_zero(ball_) != 0; }
  bool contains(const Ball& inner) const { return arb_contains(ball_, inner.ball_) != 0; }
  bool overlaps(const Ball& other) const { return arb_overlaps(ball_, other.ball_) != 0; }

  /// The midpoint as an exact ball; the radius likewise.
  Ball midpoint() const;
  Ball radius() const;
  /// The least number that is at least |x| for every x in the ball, up to rounding upwards.
  Ball magnitude() const;
  /// Decimal logarithm of radius / |midpoint|, with its sign changed: correct digits. 0 when nothing is known.
  double digits() const;

  /// The midpoint, rounded to the nearest double.
  double toDouble() const;
  /// The midpoint with this many significant digits ("-1.2345e-7"); the radius is not in the text.
  std::string midpointToDecimal(int significant_digits) const;
  /// "[1.2345 +/- 6.7e-8]", with at most this many digits and only those that are certain up to the stated radius.
  std::string toDecimal(int significant_digits) const;

  Ball& operator+=(const Ball& b);
  Ball& operator-=(const Ball& b);
  Ball& operator*=(const Ball& b);
  Ball& operator/=(const Ball& b);
  Ball operator-() const;

  friend Ball operator+(Ball a, const Ball& b) { return a += b; }
  friend Ball operator-(Ball a, const Ball& b) { return a -= b; }
  friend Ball operator*(Ball a, const Ball& b) { return a *= b; }
  friend Ball operator/(Ball a, const Ball& b) { return a /= b; }
  friend bool operator<(const Ball& a, const Ball& b) { return arb_lt(a.ball_, b.ball_) != 0; }
  friend bool operator<=(const Ball& a, const Ball& b) { return arb_le(a.ball_, b.ball_) != 0; }
  friend bool operator>(const Ball& a, const Ball& b) { return arb_gt(a.ball_, b.ball_) != 0; }
  friend bool operator>=(const Ball& a, const Ball& b) { return arb_ge(a.ball_, b.ball_) != 0; }
  friend bool operator==(const Ball& a, const Ball& b) { return arb_eq(a.ball_, b.ball_) != 0; }
  friend bool operator!=(const Ball& a, const Ball& b) { return arb_ne(a.ball_, b.ball_) != 0; }

 private:
  arb_t ball_;
};

Ball sqrt(const Ball& x);
Ball abs(const Ball& x);
Ball atan(const Ball& x);
/// The angle of (x, y), in [-pi, pi]; a ball that meets the branch cut gives all of both sides.
Ball atan2(const Ball& y, const Ball& x);
Ball acos(const Ball& x);
Ball sin(const Ball& x);
Ball cos(const Ball& x);
/// Contain the smaller (larger) number for every choice inside the arguments.
Ball min(const Ball& a, const Ball& b);
Ball max(const Ball& a, const Ball& b);
inline bool isfinite(const Ball& x) { return x.isFinite(); }

/// Throws Undecided where the ball holds positive numbers and others.
bool isPositive(const Ball& x);
/// `magnitude` with the sign of `sign`; with either where the ball does not tell.
Ball withSignOf(const Ball& magnitude, const Ball& sign);

}  // namespace irradiff

/// Lets Eigen store balls and add, scale and multiply matrices of them.
template <>
struct Eigen::NumTraits<irradiff::Ball> {
  using Real = irradiff::Ball;
  using NonInteger = irradiff::Ball;
  using Nested = irradiff::Ball;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 10,
    AddCost = 50,
    MulCost = 100
  };
  static Real epsilon() { return irradiff::Ball::powerOfTwo(1 - irradiff::WorkingPrecision::bits()); }
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen looks for this name.
  static Real dummy_precision() { return epsilon(); }
  static int digits10() { return static_cast<int>(irradiff::WorkingPrecision::bits() * 3 / 10); }
};
