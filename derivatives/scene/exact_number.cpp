#include "derivatives/scene/exact_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace irradiff {

namespace {

constexpr int kLimbBits = 32;

}  // namespace

ExactNumber::ExactNumber(double value, int exponent) : is_negative_(value < 0.0) {
  if (value == 0.0) return;
  int value_exponent = 0;
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(value), &value_exponent), 53));
  exponent += value_exponent - 53;
  exponent_ = exponent >= 0 ? exponent / kLimbBits : -((-exponent + kLimbBits - 1) / kLimbBits);
  const auto shift = static_cast<int>(exponent - exponent_ * kLimbBits);
  // The mantissa, shifted by less than a limb, in three limbs.
  limbs_.resize(3);
  limbs_[0] = static_cast<std::uint32_t>(mantissa << shift);
  mantissa >>= kLimbBits - shift;
  limbs_[1] = static_cast<std::uint32_t>(mantissa);
  limbs_[2] = static_cast<std::uint32_t>(mantissa >> kLimbBits);
  normalize();
}

ExactNumber::Leading ExactNumber::leading() const {
  // Three limbs hold at least 65 leading bits; what is below them is less than half an ulp of the result.
  double magnitude = 0.0;
  const std::size_t count = std::min<std::size_t>(limbs_.size(), 3);
  for (std::size_t i = 0; i < count; ++i) {
    magnitude = magnitude * 0x1p32 + static_cast<double>(limbs_[limbs_.size() - 1 - i]);
  }
  int exponent = 0;
  const double mantissa = std::frexp(is_negative_ ? -magnitude : magnitude, &exponent);
  if (mantissa != 0.0) exponent += static_cast<int>(kLimbBits * (end() - static_cast<std::int64_t>(count)));
  return {mantissa, exponent};
}

double ExactNumber::rounded() const {
  const Leading number = leading();
  return std::ldexp(number.mantissa, number.exponent);
}

std::vector<double> ExactNumber::parts(int scale) const {
  std::vector<double> parts;
  for (std::size_t i = limbs_.size(); i-- > 0;) {
    const std::int64_t exponent = kLimbBits * (exponent_ + static_cast<std::int64_t>(i)) - scale;
    if (exponent < -1000) break;
    const double part = std::ldexp(static_cast<double>(limbs_[i]), static_cast<int>(exponent));
    parts.push_back(is_negative_ ? -part : part);
  }
  return parts;
}

ExactNumber ExactNumber::operator-() const {
  ExactNumber negated = *this;
  negated.is_negative_ = !is_negative_ && !limbs_.empty();
  return negated;
}

void ExactNumber::normalize() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  const auto first = std::find_if(limbs_.begin(), limbs_.end(), [](std::uint32_t limb) { return limb != 0; });
  exponent_ += first - limbs_.begin();
  limbs_.erase(limbs_.begin(), first);
  if (limbs_.empty()) {
    exponent_ = 0;
    is_negative_ = false;
  }
}

std::uint32_t ExactNumber::limbAt(std::int64_t position) const {
  return position < exponent_ || position >= end() ? 0 : limbs_[static_cast<std::size_t>(position - exponent_)];
}

int ExactNumber::compareMagnitudes(const ExactNumber& a, const ExactNumber& b) {
  if (a.limbs_.empty() || b.limbs_.empty())
    return static_cast<int>(b.limbs_.empty()) - static_cast<int>(a.limbs_.empty());
  if (a.end() != b.end()) return a.end() > b.end() ? 1 : -1;
  for (std::int64_t i = a.end(); i-- > std::min(a.exponent_, b.exponent_);) {
    const std::uint32_t of_a = a.limbAt(i);
    const std::uint32_t of_b = b.limbAt(i);
    if (of_a != of_b) return of_a > of_b ? 1 : -1;
  }
  return 0;
}

ExactNumber ExactNumber::sumOfMagnitudes(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber sum;
  sum.exponent_ = std::min(a.exponent_, b.exponent_);
  const std::int64_t end = std::max(a.end(), b.end());
  sum.limbs_.reserve(static_cast<std::size_t>(end - sum.exponent_) + 1);
  std::uint64_t carry = 0;
  for (std::int64_t i = sum.exponent_; i < end; ++i) {
    carry += std::uint64_t{a.limbAt(i)} + b.limbAt(i);
    sum.limbs_.push_back(static_cast<std::uint32_t>(carry));
    carry >>= kLimbBits;
  }
  sum.limbs_.push_back(static_cast<std::uint32_t>(carry));
  sum.normalize();
  return sum;
}

ExactNumber ExactNumber::differenceOfMagnitudes(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber difference;
  difference.exponent_ = std::min(a.exponent_, b.exponent_);
  difference.limbs_.reserve(static_cast<std::size_t>(a.end() - difference.exponent_));
  std::uint64_t borrow = 0;
  for (std::int64_t i = difference.exponent_; i < a.end(); ++i) {
    const std::uint64_t minuend = a.limbAt(i);
    const std::uint64_t subtrahend = b.limbAt(i) + borrow;
    borrow = minuend < subtrahend ? 1 : 0;
    difference.limbs_.push_back(static_cast<std::uint32_t>(minuend - subtrahend));
  }
  difference.normalize();
  return difference;
}

ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) {
  if (a.limbs_.empty()) return b;
  if (b.limbs_.empty()) return a;
  if (a.is_negative_ == b.is_negative_) {
    ExactNumber sum = ExactNumber::sumOfMagnitudes(a, b);
    sum.is_negative_ = a.is_negative_;
    return sum;
  }
  const bool a_is_larger = ExactNumber::compareMagnitudes(a, b) >= 0;
  const ExactNumber& larger = a_is_larger ? a : b;
  ExactNumber sum = ExactNumber::differenceOfMagnitudes(larger, a_is_larger ? b : a);
  sum.is_negative_ = !sum.limbs_.empty() && larger.is_negative_;
  return sum;
}

ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) { return a + (-b); }

ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber product;
  if (a.limbs_.empty() || b.limbs_.empty()) return product;
  product.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  product.exponent_ = a.exponent_ + b.exponent_;
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
      carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j];
      product.limbs_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= kLimbBits;
    }
    product.limbs_[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  product.is_negative_ = a.is_negative_ != b.is_negative_;
  product.normalize();
  return product;
}

}  // namespace irradiff
