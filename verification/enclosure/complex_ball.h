#pragma once

#include "verification/enclosure/ball.h"

#include <acb.h>

namespace irradiff {

/// A complex number known to lie in a rectangle (Arb): what a Ball is for the real line. Functions with a branch cut
/// are not finite where their argument meets the cut, so that a finite result also says: holomorphic on the whole
/// rectangle.
class ComplexBall {
 public:
  ComplexBall() { acb_init(ball_); }
  ComplexBall(const ComplexBall& other) : ComplexBall() { acb_set(ball_, other.ball_); }
  ComplexBall(ComplexBall&& other) noexcept : ComplexBall() { acb_swap(ball_, other.ball_); }
  ComplexBall& operator=(const ComplexBall& other) {
    acb_set(ball_, other.ball_);
    return *this;
  }
  ComplexBall& operator=(ComplexBall&& other) noexcept {
    acb_swap(ball_, other.ball_);
    return *this;
  }
  ~ComplexBall() { acb_clear(ball_); }

  ComplexBall(double exact) : ComplexBall() { acb_set_d(ball_, exact); }             // NOLINT: scalars mix
  ComplexBall(const Ball& real) : ComplexBall() { acb_set_arb(ball_, real.get()); }  // NOLINT: scalars mix
  ComplexBall(const Ball& real, const Ball& imaginary) : ComplexBall() {
    acb_set_arb_arb(ball_, real.get(), imaginary.get());
  }
  explicit ComplexBall(const acb_struct* ball) : ComplexBall() { acb_set(ball_, ball); }

  const acb_struct* get() const { return ball_; }
  acb_struct* get() { return ball_; }
  bool isFinite() const { return acb_is_finite(ball_) != 0; }
  bool containsZero() const { return acb_contains_zero(ball_) != 0; }
  /// At least |z| for every z in the rectangle.
  Ball magnitude() const {
    Ball result;
    acb_get_abs_ubound_arf(arb_midref(result.get()), ball_, WorkingPrecision::bits());
    return result;
  }

  ComplexBall& operator+=(const ComplexBall& b) {
    acb_add(ball_, ball_, b.ball_, WorkingPrecision::bits());
    return *this;
  }
  ComplexBall& operator-=(const ComplexBall& b) {
    acb_sub(ball_, ball_, b.ball_, WorkingPrecision::bits());
    return *this;
  }
  ComplexBall& operator*=(const ComplexBall& b) {
    acb_mul(ball_, ball_, b.ball_, WorkingPrecision::bits());
    return *this;
  }
  ComplexBall& operator/=(const ComplexBall& b) {
    acb_div(ball_, ball_, b.ball_, WorkingPrecision::bits());
    return *this;
  }
  ComplexBall operator-() const {
    ComplexBall result;
    acb_neg(result.ball_, ball_);
    return result;
  }
  friend ComplexBall operator+(ComplexBall a, const ComplexBall& b) { return a += b; }
  friend ComplexBall operator-(ComplexBall a, const ComplexBall& b) { return a -= b; }
  friend ComplexBall operator*(ComplexBall a, const ComplexBall& b) { return a *= b; }
  friend ComplexBall operator/(ComplexBall a, const ComplexBall& b) { return a /= b; }

 private:
  acb_t ball_;
};

/// Principal branch, cut along the negative real axis.
inline ComplexBall sqrt(const ComplexBall& z) {
  ComplexBall result;
  acb_sqrt_analytic(result.get(), z.get(), 1, WorkingPrecision::bits());
  return result;
}

/// Principal branch, cut along the imaginary axis outside [-i, i].
inline ComplexBall atan(const ComplexBall& z) {
  ComplexBall result;
  if (arb_contains_zero(acb_realref(z.get())) != 0) {
    Ball imaginary;
    arb_abs(imaginary.get(), acb_imagref(z.get()));
    if (!(imaginary < Ball(1))) {
      acb_indeterminate(result.get());
      return result;
    }
  }
  acb_atan(result.get(), z.get(), WorkingPrecision::bits());
  return result;
}

}  // namespace irradiff

template <>
struct Eigen::NumTraits<irradiff::ComplexBall> {
  using Real = irradiff::Ball;
  using NonInteger = irradiff::ComplexBall;
  using Nested = irradiff::ComplexBall;
  using Literal = double;
  // Eigen's own meaning of IsComplex wants std::complex; it only stores these.
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 20,
    AddCost = 100,
    MulCost = 400
  };
};
