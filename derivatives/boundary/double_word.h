#pragma once

#include <cmath>
#include <concepts>
#include <limits>

namespace irradiff {

/// An unevaluated sum hi + lo of two floating-point numbers, |lo| <= ulp(hi)/2: twice the precision of T, the same
/// exponents.
///
/// Geometry that cancels (r x e of a near-radial edge, n.r near the horizon, the height over a plane) is computed in it
/// and rounded once, so that the differences "vertex minus receiver" enter exactly. Relative errors, u being the unit
/// roundoff of T: sum 3 u^2, product 5 u^2, quotient 10 u^2 (Joldes, Muller, Popescu 2017, "Tight and rigorous error
/// bounds for basic building blocks of double-word arithmetic", algorithms 6, 12 and 17), barring overflow and
/// underflow.
template <std::floating_point T>
struct DoubleWord {
  T hi{};
  T lo{};

  constexpr DoubleWord() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): every T is exactly a DoubleWord<T>.
  constexpr DoubleWord(T value) : hi(value) {}
  constexpr DoubleWord(T high, T low) : hi(high), lo(low) {}

  explicit constexpr operator T() const { return hi + lo; }

  constexpr DoubleWord operator-() const { return {-hi, -lo}; }
};

/// a + b without error; requires |a| >= |b| or a == 0.
template <std::floating_point T>
constexpr DoubleWord<T> fastTwoSum(T a, T b) {
  const T sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b without error (Knuth).
template <std::floating_point T>
constexpr DoubleWord<T> twoSum(T a, T b) {
  const T sum = a + b;
  const T b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a - b without error.
template <std::floating_point T>
constexpr DoubleWord<T> twoDifference(T a, T b) {
  return twoSum(a, -b);
}

/// a * b without error, barring overflow (|a|, |b| < 2^996 in double) and underflow. Uses the fused multiply-add where
/// the target has one; elsewhere Dekker's product on halves split as Veltkamp does, since a library fma costs more than
/// the splitting.
template <std::floating_point T>
inline DoubleWord<T> twoProduct(T a, T b) {
  const T product = a * b;
#if defined(__FMA__)
  return {product, std::fma(a, b, -product)};
#else
  constexpr int kHalfDigits = (std::numeric_limits<T>::digits + 1) / 2;
  constexpr T kSplitter = static_cast<T>((1ULL << kHalfDigits) + 1ULL);
  const T a_scaled = kSplitter * a;
  const T a_high = a_scaled - (a_scaled - a);
  const T a_low = a - a_high;
  const T b_scaled = kSplitter * b;
  const T b_high = b_scaled - (b_scaled - b);
  const T b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
#endif
}

template <std::floating_point T>
constexpr DoubleWord<T> operator+(const DoubleWord<T>& a, const DoubleWord<T>& b) {
  const DoubleWord<T> high = twoSum(a.hi, b.hi);
  const DoubleWord<T> low = twoSum(a.lo, b.lo);
  const DoubleWord<T> middle = fastTwoSum(high.hi, high.lo + low.hi);
  return fastTwoSum(middle.hi, low.lo + middle.lo);
}

template <std::floating_point T>
constexpr DoubleWord<T> operator-(const DoubleWord<T>& a, const DoubleWord<T>& b) {
  return a + (-b);
}

template <std::floating_point T>
inline DoubleWord<T> operator*(const DoubleWord<T>& a, const DoubleWord<T>& b) {
  const DoubleWord<T> high = twoProduct(a.hi, b.hi);
  return fastTwoSum(high.hi, high.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// Requires b != 0.
template <std::floating_point T>
inline DoubleWord<T> operator/(const DoubleWord<T>& a, const DoubleWord<T>& b) {
  const T quotient = a.hi / b.hi;
  const DoubleWord<T> remainder = a - b * DoubleWord<T>(quotient);
  return fastTwoSum(quotient, remainder.hi / b.hi);
}

}  // namespace irradiff
