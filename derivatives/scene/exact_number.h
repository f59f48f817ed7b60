#pragma once

#include <cstdint>
#include <vector>

namespace irradiff {

/// A dyadic rational of any size: sums, differences and products of doubles without error, whatever their exponents.
/// Slow, for the predicates that floating point cannot decide. Numbers must be finite.
class ExactNumber {
 public:
  ExactNumber() = default;
  /// value * 2^exponent.
  explicit ExactNumber(double value, int exponent = 0);

  ExactNumber operator-() const;
  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) { return a + (-b); }
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b);

  int sign() const { return digits_.empty() ? 0 : (is_negative_ ? -1 : 1); }

  /// mantissa * 2^exponent, cut off towards 0: |mantissa| in [1/2, 1), relative error below 2^-52. 0 is {0, 0}.
  struct Truncated {
    double mantissa;
    int exponent;
  };
  Truncated truncated() const;

 private:
  void trim();

  // The magnitude is the sum of digits_[i] * 2^(32 (i + scale_)), without zeros at either end.
  std::vector<std::uint32_t> digits_;
  int scale_ = 0;
  bool is_negative_ = false;
};

}  // namespace irradiff
