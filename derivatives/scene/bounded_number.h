#pragma once

#include <cmath>
#include <limits>

namespace irradiff {

/// A double with a bound of its distance from the exact value, carried through +, - and * (running error analysis:
/// Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., section 3.3). The filter in front of ExactNumber:
/// a formula written for either decides its sign here, or says that it cannot. Overflow and underflow make the bound
/// useless or cover themselves, never wrong.
class BoundedNumber {
 public:
  BoundedNumber() = default;
  explicit BoundedNumber(double value) : value_(value) {}

  BoundedNumber operator-() const { return {-value_, error_}; }
  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    const double sum = a.value_ + b.value_;
    return {sum, kInflation * (a.error_ + b.error_ + kUnitRoundoff * std::abs(sum))};
  }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) { return a + (-b); }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    const double product = a.value_ * b.value_;
    return {product, kInflation * (std::abs(a.value_) * b.error_ + std::abs(b.value_) * a.error_ + a.error_ * b.error_ +
                                   kUnitRoundoff * std::abs(product)) +
                         kUnderflow};
  }

  /// Whether the sign of value() is certain.
  bool isCertain() const { return std::abs(value_) > error_; }
  double value() const { return value_; }

 private:
  BoundedNumber(double value, double error) : value_(value), error_(error) {}

  static constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;
  /// For the roundings of the bound itself, at most seven.
  static constexpr double kInflation = 1 + 16 * kUnitRoundoff;
  /// For products below the normal range: the value's and four of the bound's.
  static constexpr double kUnderflow = 8 * std::numeric_limits<double>::denorm_min();

  double value_ = 0.0;
  double error_ = 0.0;
};

}  // namespace irradiff
