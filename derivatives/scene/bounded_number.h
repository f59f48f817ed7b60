#pragma once

#include <cmath>
#include <limits>

namespace irradiff {

/// A double and a bound of its distance from the exact number it stands for: the filter of a predicate. Sums,
/// differences and products carry the bound along; where it does not tell the sign, the same formula runs at
/// ExactNumber. A result beyond the range of double has an infinite or undefined bound, and no sign.
class BoundedNumber {
 public:
  BoundedNumber() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): every double is a BoundedNumber without error.
  BoundedNumber(double value) : value_(value) {}
  BoundedNumber(double value, double error) : value_(value), error_(error) {}

  double value() const { return value_; }
  double error() const { return error_; }

  /// Whether the sign of the exact number is known; not where it is 0, unless the number has no error at all.
  bool hasSign() const { return std::abs(value_) > error_ || (value_ == 0.0 && error_ == 0.0); }
  /// Requires hasSign().
  int sign() const { return (value_ > 0.0) - (value_ < 0.0); }

  BoundedNumber operator-() const { return {-value_, error_}; }

  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    const double sum = a.value_ + b.value_;
    return {sum, (a.error_ + b.error_ + kUnitRoundoff * std::abs(sum)) * kInflation};
  }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) { return a + (-b); }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    // Coordinates are often 0, and an exact 0 needs no second look.
    if (a.isZero() || b.isZero()) return {};
    const double product = a.value_ * b.value_;
    const double propagated = std::abs(a.value_) * b.error_ + std::abs(b.value_) * a.error_ + a.error_ * b.error_;
    return {product, (propagated + kUnitRoundoff * std::abs(product)) * kInflation + kUnderflow};
  }

 private:
  bool isZero() const { return value_ == 0.0 && error_ == 0.0; }

  static constexpr double kUnitRoundoff = 0x1p-53;
  /// Covers the roundings of the bound itself, at most five in a product.
  static constexpr double kInflation = 1.0 + 0x1p-49;
  /// What the product and the products in its bound may lose below the normal range.
  static constexpr double kUnderflow = std::numeric_limits<double>::min();

  double value_ = 0.0;
  double error_ = 0.0;
};

}  // namespace irradiff
