#pragma once

#include <array>
#include <cstddef>

namespace irradiff::enclosure {

/// A function of the receiver's N coordinates up to second order: value, gradient and the upper triangle of the Hessian
/// (row by row). Arithmetic truncates, so that evaluating a formula in it gives the formula's exact first and second
/// derivatives. It holds balls, real or complex, and nothing else is assumed of Scalar but + - * /.
template <class Scalar, std::size_t N>
struct SecondOrderTaylor {
  static constexpr std::size_t kSecond = N * (N + 1) / 2;
  static constexpr std::size_t kTerms = 1 + N + kSecond;

  Scalar value{};
  std::array<Scalar, N> gradient{};
  std::array<Scalar, kSecond> hessian{};

  SecondOrderTaylor() = default;
  SecondOrderTaylor(const Scalar& constant) : value(constant) {}  // NOLINT: constants mix with functions

  static SecondOrderTaylor variable(const Scalar& value, std::size_t index) {
    SecondOrderTaylor x(value);
    x.gradient[index] = Scalar(1.0);
    return x;
  }

  /// The same function over a wider scalar (balls seen as complex balls).
  template <class Other>
  SecondOrderTaylor<Other, N> cast() const {
    SecondOrderTaylor<Other, N> result{Other(value)};
    for (std::size_t i = 0; i < N; ++i) result.gradient[i] = Other(gradient[i]);
    for (std::size_t k = 0; k < kSecond; ++k) result.hessian[k] = Other(hessian[k]);
    return result;
  }

  /// Value, gradient, Hessian in one row.
  std::array<Scalar, kTerms> terms() const {
    std::array<Scalar, kTerms> row;
    row[0] = value;
    for (std::size_t i = 0; i < N; ++i) row[1 + i] = gradient[i];
    for (std::size_t k = 0; k < kSecond; ++k) row[1 + N + k] = hessian[k];
    return row;
  }

  SecondOrderTaylor& operator+=(const SecondOrderTaylor& b) {
    value += b.value;
    for (std::size_t i = 0; i < N; ++i) gradient[i] += b.gradient[i];
    for (std::size_t k = 0; k < kSecond; ++k) hessian[k] += b.hessian[k];
    return *this;
  }
  SecondOrderTaylor& operator-=(const SecondOrderTaylor& b) {
    value -= b.value;
    for (std::size_t i = 0; i < N; ++i) gradient[i] -= b.gradient[i];
    for (std::size_t k = 0; k < kSecond; ++k) hessian[k] -= b.hessian[k];
    return *this;
  }
  SecondOrderTaylor& operator*=(const Scalar& s) {
    value *= s;
    for (Scalar& g : gradient) g *= s;
    for (Scalar& h : hessian) h *= s;
    return *this;
  }
  SecondOrderTaylor operator-() const {
    SecondOrderTaylor result(*this);
    return result *= Scalar(-1.0);
  }

  friend SecondOrderTaylor operator+(SecondOrderTaylor a, const SecondOrderTaylor& b) { return a += b; }
  friend SecondOrderTaylor operator-(SecondOrderTaylor a, const SecondOrderTaylor& b) { return a -= b; }
  friend SecondOrderTaylor operator*(SecondOrderTaylor a, const Scalar& s) { return a *= s; }
  friend SecondOrderTaylor operator*(const SecondOrderTaylor& a, const SecondOrderTaylor& b) {
    SecondOrderTaylor c(a.value * b.value);
    for (std::size_t i = 0; i < N; ++i) c.gradient[i] = a.value * b.gradient[i] + b.value * a.gradient[i];
    for (std::size_t i = 0, k = 0; i < N; ++i) {
      for (std::size_t j = i; j < N; ++j, ++k) {
        c.hessian[k] = a.value * b.hessian[k] + b.value * a.hessian[k] + a.gradient[i] * b.gradient[j] +
                       a.gradient[j] * b.gradient[i];
      }
    }
    return c;
  }
  friend SecondOrderTaylor operator/(const SecondOrderTaylor& a, const SecondOrderTaylor& b) { return a * inverse(b); }
};

/// g(u), given g, g' and g'' at the value of u.
template <class Scalar, std::size_t N>
SecondOrderTaylor<Scalar, N> compose(const SecondOrderTaylor<Scalar, N>& u, const Scalar& g, const Scalar& first,
                                     const Scalar& second) {
  SecondOrderTaylor<Scalar, N> result(g);
  for (std::size_t i = 0; i < N; ++i) result.gradient[i] = first * u.gradient[i];
  for (std::size_t i = 0, k = 0; i < N; ++i) {
    const Scalar scaled = second * u.gradient[i];
    for (std::size_t j = i; j < N; ++j, ++k) result.hessian[k] = first * u.hessian[k] + scaled * u.gradient[j];
  }
  return result;
}

template <class Scalar, std::size_t N>
SecondOrderTaylor<Scalar, N> inverse(const SecondOrderTaylor<Scalar, N>& u) {
  const Scalar g = Scalar(1.0) / u.value;
  const Scalar first = -(g * g);
  return compose(u, g, first, Scalar(-2.0) * first * g);
}

}  // namespace irradiff::enclosure
