#pragma once

#include <cstdint>
#include <vector>

namespace irradiff {

/// A dyadic rational of any size: sums, differences and products of finite doubles without error, overflow or
/// underflow. What a filter cannot decide in floating point is decided with it.
class ExactNumber {
 public:
  ExactNumber() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): every finite double is exactly an ExactNumber.
  ExactNumber(double value) : ExactNumber(value, 0) {}
  /// value 2^exponent.
  ExactNumber(double value, int exponent);

  /// -1, 0 or 1.
  int sign() const { return limbs_.empty() ? 0 : (is_negative_ ? -1 : 1); }

  /// mantissa 2^exponent with |mantissa| in [1/2, 1], the number to a relative error of 2^-52; 0 is {0, 0}.
  struct Leading {
    double mantissa;
    int exponent;
  };
  Leading leading() const;

  /// The same as a double: infinite beyond its range, and less accurate below the normal numbers.
  double rounded() const;

  /// The least k with |number| < 2^k that is a multiple of 32; 0 for 0.
  int exponent() const { return static_cast<int>(32 * end()); }

  /// Doubles, the largest first, whose sum is number/2^scale; what falls below the range of double is left out.
  std::vector<double> parts(int scale) const;

  ExactNumber operator-() const;
  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b);

 private:
  void normalize();
  static int compareMagnitudes(const ExactNumber& a, const ExactNumber& b);
  static ExactNumber sumOfMagnitudes(const ExactNumber& a, const ExactNumber& b);
  /// |a| - |b|; requires |a| >= |b|.
  static ExactNumber differenceOfMagnitudes(const ExactNumber& a, const ExactNumber& b);

  /// The limb of 2^(32 position), 0 outside.
  std::uint32_t limbAt(std::int64_t position) const;
  std::int64_t end() const { return exponent_ + static_cast<std::int64_t>(limbs_.size()); }

  // The magnitude is the sum of limbs_[i] 2^(32 (exponent_ + i)); neither the first nor the last limb is 0, and 0 has
  // none.
  std::vector<std::uint32_t> limbs_;
  std::int64_t exponent_ = 0;
  bool is_negative_ = false;
};

}  // namespace irradiff
