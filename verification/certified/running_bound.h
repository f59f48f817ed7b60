#pragma once

#include "derivatives/boundary/double_word.h"
#include "derivatives/boundary/scalar.h"
#include "verification/enclosure/undecided.h"

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <limits>

namespace irradiff {

/// The arithmetic that a RunningBound runs in: relative errors of its operations, and what is lost below the normal
/// range.
template <class T>
struct Rounding;

template <std::floating_point T>
struct Rounding<T> {
  static constexpr double kSum = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2.0;
  static constexpr double kProduct = kSum;
  static constexpr double kQuotient = kSum;
  static constexpr double kRoot = kSum;
  /// sin, cos and atan2 of the C library are assumed within one unit in the last place.
  static constexpr double kFunction = 2.0 * kSum;
  static double magnitude(T value) { return static_cast<double>(std::abs(value)); }
  /// What a sum is rounded by; those of double are exact where that underflows.
  static double ofSum(T sum) {
    const double error = kSum * magnitude(sum);
    if constexpr (!std::same_as<T, double>) {
      if (error < std::numeric_limits<double>::min() && sum != 0) return std::numeric_limits<double>::min();
    }
    return error;
  }
};

/// docs/derivations/certified_bounds.md, section 2; Joldes, Muller, Popescu 2017 give 3, 7 and 15 u^2.
template <>
struct Rounding<DoubleWord<double>> {
  static constexpr double kSum = 0x1p-104;
  static constexpr double kProduct = 0x1p-103;
  static constexpr double kQuotient = 0x1p-101;
  static double magnitude(const DoubleWord<double>& value) { return std::abs(value.hi); }
  static double ofSum(const DoubleWord<double>& sum) { return kSum * magnitude(sum); }
};

/// A number of type T and a running bound of its distance from the exact number it stands for (Wilkinson's running
/// error analysis). T is double, long double or DoubleWord<double>; the formulas of derivatives/ run at it as they are.
///
/// The bounds are computed in double, rounded to nearest, and are sums, products and quotients of positive numbers
/// alone, so that the chain of up to a million roundings behind one leaves it right to a factor of 1 + 2^-30: whoever
/// reads error() gets that factor on top. An operation that has no bound (a divisor that may be 0) has the error
/// infinity or NaN, and everything after it.
///
/// Comparisons are certain: `a < b` says that it holds for all numbers within the bounds.
template <class T>
class RunningBound {
 public:
  RunningBound() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a double is a scalar wherever one of these is.
  RunningBound(double exact) : value_(T(exact)) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  RunningBound(const T& exact) requires(!std::same_as<T, double>) : value_(exact) {}
  /// `error` >= 0 bounds the distance of the exact number from `value`.
  RunningBound(const T& value, double error) : value_(value), error_(error) {}
  /// Every RunningBound of a machine number is one in double words, which hold that number without error.
  template <std::floating_point Narrow>
  requires(!std::floating_point<T>) explicit RunningBound(const RunningBound<Narrow>& narrow)
      : value_(wordOf(narrow.value())), error_(narrow.rawError()) {}

  /// Rounded to a machine number, with what that costs.
  template <std::floating_point Narrow>
  requires(!std::same_as<T, Narrow>) explicit operator RunningBound<Narrow>() const {
    const Narrow rounded = machineNumber<Narrow>();
    return {rounded, error_ + Rounding<Narrow>::kSum * Rounding<Narrow>::magnitude(rounded)};
  }

  const T& value() const { return value_; }
  double error() const { return error_ * kInflation; }
  /// Without the factor for the roundings of the bound itself.
  double rawError() const { return error_; }
  bool isFinite() const { return error_ < std::numeric_limits<double>::infinity(); }

  RunningBound operator-() const { return {-value_, error_}; }

  friend RunningBound operator+(const RunningBound& a, const RunningBound& b) {
    const T sum = a.value_ + b.value_;
    return {sum, a.error_ + b.error_ + Rounding<T>::ofSum(sum)};
  }
  friend RunningBound operator-(const RunningBound& a, const RunningBound& b) {
    const T difference = a.value_ - b.value_;
    return {difference, a.error_ + b.error_ + Rounding<T>::ofSum(difference)};
  }
  friend RunningBound operator*(const RunningBound& a, const RunningBound& b) {
    const T product = a.value_ * b.value_;
    return {product, Rounding<T>::magnitude(a.value_) * b.error_ +
                         (Rounding<T>::magnitude(b.value_) + b.error_) * a.error_ +
                         Rounding<T>::kProduct * Rounding<T>::magnitude(product) + kUnderflow};
  }
  friend RunningBound operator/(const RunningBound& a, const RunningBound& b) {
    const double divisor = Rounding<T>::magnitude(b.value_);
    // Half the divisor is kept: the difference of the two must not cancel.
    if (!(b.error_ <= 0.5 * divisor) || divisor == 0.0) return unbounded();
    const T quotient = a.value_ / b.value_;
    const double size = Rounding<T>::magnitude(quotient);
    // What underflows is divided too.
    return {quotient, (a.error_ + size * b.error_ + kUnderflow) / (divisor - b.error_) + Rounding<T>::kQuotient * size +
                          kUnderflow};
  }
  RunningBound& operator+=(const RunningBound& b) { return *this = *this + b; }
  RunningBound& operator-=(const RunningBound& b) { return *this = *this - b; }
  RunningBound& operator*=(const RunningBound& b) { return *this = *this * b; }
  RunningBound& operator/=(const RunningBound& b) { return *this = *this / b; }

  friend bool operator<(const RunningBound& a, const RunningBound& b) { return gap(b, a) > 0.0; }
  friend bool operator>(const RunningBound& a, const RunningBound& b) { return gap(a, b) > 0.0; }
  friend bool operator<=(const RunningBound& a, const RunningBound& b) { return gap(b, a) >= 0.0; }
  friend bool operator>=(const RunningBound& a, const RunningBound& b) { return gap(a, b) >= 0.0; }

  friend bool operator==(const RunningBound& a, const RunningBound& b) {
    return a.error_ == 0.0 && b.error_ == 0.0 && static_cast<double>(a.value_ - b.value_) == 0.0;
  }

  /// A number of which nothing is known.
  static RunningBound unbounded() { return {T(0.0), std::numeric_limits<double>::infinity()}; }

  /// What the products in a value and in its bound may lose below the normal range.
  static constexpr double kUnderflow = std::numeric_limits<double>::min();

 private:
  static constexpr double kInflation = 1.0 + 0x1p-30;

  template <std::floating_point Narrow>
  static DoubleWord<double> wordOf(Narrow value) {
    const auto high = static_cast<double>(value);
    return {high, static_cast<double>(value - static_cast<Narrow>(high))};
  }

  template <std::floating_point Narrow>
  Narrow machineNumber() const {
    if constexpr (std::floating_point<T>) {
      return static_cast<Narrow>(value_);
    } else {
      return static_cast<Narrow>(value_.hi) + static_cast<Narrow>(value_.lo);
    }
  }

  /// The least that a exceeds b by; NaN where nothing is known. The sign is that of the exact difference.
  static double gap(const RunningBound& a, const RunningBound& b) {
    const T difference = a.value_ - b.value_;
    const double error = (a.error_ + b.error_) * kInflation;
    const double value = static_cast<double>(difference);
    if (error == 0.0) return value;
    return value - (error + 0x1p-50 * std::abs(value));
  }

  T value_ = T(0.0);
  double error_ = 0.0;
};

template <class T>
RunningBound<T> abs(const RunningBound<T>& a) {
  return static_cast<double>(a.value()) < 0.0 ? -a : a;
}

/// The root of a number that is known not to be negative, whatever its bound says.
template <std::floating_point T>
RunningBound<T> sqrt(const RunningBound<T>& a) {
  if (!(a.value() > 0)) return {T(0), std::sqrt(a.rawError())};
  const T root = std::sqrt(a.value());
  const double size = Rounding<T>::magnitude(root);
  // |sqrt(a') - sqrt(a)| <= |a' - a|/sqrt(a).
  return {root, a.rawError() / size + Rounding<T>::kRoot * size};
}

template <std::floating_point T>
RunningBound<T> cos(const RunningBound<T>& a) {
  const T value = std::cos(a.value());
  return {value, a.rawError() + Rounding<T>::kFunction * Rounding<T>::magnitude(value)};
}

template <std::floating_point T>
RunningBound<T> atan2(const RunningBound<T>& y, const RunningBound<T>& x) {
  const T value = std::atan2(y.value(), x.value());
  const double y_error = y.rawError();
  const double x_error = x.rawError();
  const double y_size = Rounding<T>::magnitude(y.value());
  const double x_size = Rounding<T>::magnitude(x.value());
  const double distance = std::sqrt(y_size * y_size + x_size * x_size);
  const double error = y_error + x_error;
  // Near the origin nothing is known of the angle, and near the cut, x < 0 and y = 0, not which of the two ends. Below
  // the square root of the normal range the distance is not known.
  constexpr double kSmallestDistance = 0x1p-505;
  if (!(error <= 0.25 * distance) || !(distance >= kSmallestDistance) ||
      (x.value() < 0 && y_size <= y_error && y_error > 0.0)) {
    return RunningBound<T>::unbounded();
  }
  const double nearest = distance - error;
  return {value, ((x_size + x_error) * y_error + (y_size + y_error) * x_error) / (nearest * nearest) +
                     Rounding<T>::kFunction * Rounding<T>::magnitude(value) + RunningBound<T>::kUnderflow};
}

RunningBound<DoubleWord<double>> sqrt(const RunningBound<DoubleWord<double>>& a);
/// By Arb: rigorous, and a microsecond or two.
RunningBound<DoubleWord<double>> cos(const RunningBound<DoubleWord<double>>& a);
RunningBound<DoubleWord<double>> atan2(const RunningBound<DoubleWord<double>>& y,
                                       const RunningBound<DoubleWord<double>>& x);

/// Throws Undecided where the bound does not tell.
template <class T>
bool isPositive(const RunningBound<T>& x) {
  const auto value = static_cast<double>(x.value());
  if (value > x.error()) return true;
  if (value <= 0.0 && (x.rawError() == 0.0 || -value >= x.error())) return false;
  throw Undecided("the sign of a number that decides what is added up");
}

template <class T>
RunningBound<T> withSignOf(const RunningBound<T>& magnitude, const RunningBound<T>& sign) {
  const auto value = static_cast<double>(sign.value());
  if (std::abs(value) > sign.error() || sign.rawError() == 0.0) return value < 0.0 ? -magnitude : magnitude;
  return {T(0.0), Rounding<T>::magnitude(magnitude.value()) * (1.0 + 0x1p-50) + magnitude.rawError()};
}

namespace detail {
template <std::floating_point T>
struct WideOf<RunningBound<T>> {
  using Type = RunningBound<DoubleWord<double>>;
};
}  // namespace detail

}  // namespace irradiff

/// Lets Eigen store running bounds and fill matrices with them.
template <class T>
struct Eigen::NumTraits<irradiff::RunningBound<T>> {
  using Real = irradiff::RunningBound<T>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 4,
    MulCost = 8
  };
  static Real epsilon() { return Real(irradiff::Rounding<T>::kSum); }
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen looks for this name.
  static Real dummy_precision() { return epsilon(); }
  static int digits10() { return 15; }
};
