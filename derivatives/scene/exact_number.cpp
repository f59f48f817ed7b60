#include "derivatives/scene/exact_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace irradiff {
namespace {

constexpr int kDigitBits = 32;

using Digits = std::vector<std::uint32_t>;

/// The digit of weight 2^(32 position) of a magnitude that starts at `scale`.
std::uint32_t digitAt(const Digits& digits, int scale, int position) {
  const int index = position - scale;
  return index >= 0 && index < static_cast<int>(digits.size()) ? digits[static_cast<std::size_t>(index)] : 0;
}

/// The end of a magnitude's digits: the position after the highest.
int endOf(const Digits& digits, int scale) { return scale + static_cast<int>(digits.size()); }

bool isSmaller(const Digits& a, int a_scale, const Digits& b, int b_scale) {
  for (int i = std::max(endOf(a, a_scale), endOf(b, b_scale)); i-- > std::min(a_scale, b_scale);) {
    const std::uint32_t a_digit = digitAt(a, a_scale, i);
    const std::uint32_t b_digit = digitAt(b, b_scale, i);
    if (a_digit != b_digit) return a_digit < b_digit;
  }
  return false;
}

}  // namespace

ExactNumber::ExactNumber(double value, int exponent) : is_negative_(std::signbit(value)) {
  int value_exponent = 0;
  const double mantissa = std::frexp(std::abs(value), &value_exponent);
  constexpr int kMantissaBits = std::numeric_limits<double>::digits;
  const auto integer = static_cast<std::uint64_t>(std::ldexp(mantissa, kMantissaBits));
  const int shift = value_exponent + exponent - kMantissaBits;
  scale_ = shift >= 0 ? shift / kDigitBits : -((-shift + kDigitBits - 1) / kDigitBits);
  const int bits = shift - scale_ * kDigitBits;  // 0 to 31
  const std::uint64_t low = (integer & 0xFFFFFFFFU) << static_cast<unsigned>(bits);
  const std::uint64_t high = ((integer >> 32U) << static_cast<unsigned>(bits)) + (low >> 32U);
  digits_ = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high),
             static_cast<std::uint32_t>(high >> 32U)};
  trim();
}

ExactNumber ExactNumber::operator-() const {
  ExactNumber result = *this;
  result.is_negative_ = !result.is_negative_;
  return result;
}

ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) {
  if (a.sign() == 0) return b;
  if (b.sign() == 0) return a;
  ExactNumber sum;
  sum.scale_ = std::min(a.scale_, b.scale_);
  const int end = std::max(endOf(a.digits_, a.scale_), endOf(b.digits_, b.scale_));
  sum.digits_.reserve(static_cast<std::size_t>(end - sum.scale_) + 1);
  if (a.is_negative_ == b.is_negative_) {
    sum.is_negative_ = a.is_negative_;
    std::uint64_t carry = 0;
    for (int i = sum.scale_; i < end; ++i) {
      carry += std::uint64_t{digitAt(a.digits_, a.scale_, i)} + digitAt(b.digits_, b.scale_, i);
      sum.digits_.push_back(static_cast<std::uint32_t>(carry));
      carry >>= 32U;
    }
    sum.digits_.push_back(static_cast<std::uint32_t>(carry));
  } else {
    const bool is_swapped = isSmaller(a.digits_, a.scale_, b.digits_, b.scale_);
    const ExactNumber& large = is_swapped ? b : a;
    const ExactNumber& small = is_swapped ? a : b;
    sum.is_negative_ = large.is_negative_;
    std::int64_t borrow = 0;
    for (int i = sum.scale_; i < end; ++i) {
      borrow += std::int64_t{digitAt(large.digits_, large.scale_, i)} - digitAt(small.digits_, small.scale_, i);
      sum.digits_.push_back(static_cast<std::uint32_t>(borrow));
      borrow = borrow < 0 ? -1 : 0;
    }
  }
  sum.trim();
  return sum;
}

ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber product;
  product.is_negative_ = a.is_negative_ != b.is_negative_;
  product.scale_ = a.scale_ + b.scale_;
  product.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
  for (std::size_t i = 0; i < a.digits_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.digits_.size(); ++j) {
      carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + product.digits_[i + j];
      product.digits_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32U;
    }
    product.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
  }
  product.trim();
  return product;
}

ExactNumber::Truncated ExactNumber::truncated() const {
  if (digits_.empty()) return {0.0, 0};
  // Three digits hold at least 65 leading bits; those beyond 53 are cut off.
  double magnitude = 0.0;
  int bits = std::numeric_limits<double>::digits;
  int exponent = 0;
  for (std::size_t i = digits_.size(); i-- > 0 && bits > 0;) {
    const int width = magnitude == 0.0 ? std::ilogb(static_cast<double>(digits_[i])) + 1 : kDigitBits;
    const int kept = std::min(width, bits);
    const std::uint32_t digit = digits_[i] >> static_cast<unsigned>(width - kept);
    magnitude = std::ldexp(magnitude, kept) + static_cast<double>(digit);
    bits -= kept;
    exponent = kDigitBits * (scale_ + static_cast<int>(i)) + width - kept;
  }
  int mantissa_exponent = 0;
  const double mantissa = std::frexp(magnitude, &mantissa_exponent);
  return {is_negative_ ? -mantissa : mantissa, mantissa_exponent + exponent};
}

void ExactNumber::trim() {
  while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
  const auto first = std::find_if(digits_.begin(), digits_.end(), [](std::uint32_t digit) { return digit != 0; });
  scale_ += static_cast<int>(first - digits_.begin());
  digits_.erase(digits_.begin(), first);
  if (digits_.empty()) {
    scale_ = 0;
    is_negative_ = false;
  }
}

}  // namespace irradiff
