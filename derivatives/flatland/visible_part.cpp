#include "derivatives/flatland/visible_part.h"

#include "derivatives/scene/exact_number.h"

#include <cmath>

namespace irradiff {
namespace {

/// (head + tail) * 2^exponent, to 2^-104.
struct LeadingDigits {
  DoubleWord<double> digits;
  int exponent;
};

LeadingDigits leadingDigits(const ExactNumber& number) {
  const ExactNumber::Leading head = number.leading();
  const ExactNumber::Leading tail = (number - ExactNumber(head.mantissa, head.exponent)).leading();
  return {fastTwoSum(head.mantissa, std::ldexp(tail.mantissa, tail.exponent - head.exponent)), head.exponent};
}

DoubleWord<double> quotient(const ExactNumber& numerator, const ExactNumber& denominator) {
  const LeadingDigits n = leadingDigits(numerator);
  const LeadingDigits d = leadingDigits(denominator);
  const DoubleWord<double> digits = n.digits / d.digits;
  const int exponent = n.exponent - d.exponent;
  return {std::ldexp(digits.hi, exponent), std::ldexp(digits.lo, exponent)};
}

using ExactPair = std::array<ExactNumber, 2>;

ExactPair exactDifference(const Vector2<double>& a, const Vector2<double>& b) {
  return {ExactNumber(a(0)) - ExactNumber(b(0)), ExactNumber(a(1)) - ExactNumber(b(1))};
}

ExactNumber exactCross(const ExactPair& a, const ExactPair& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace

SeenPoint<double> exactCrossing(const SegmentEnds<double>& a, const SegmentEnds<double>& b,
                                const Vector2<double>& position, const Vector2<double>& normal) {
  const ExactPair edge_a = exactDifference(a[1], a[0]);
  const ExactPair edge_b = exactDifference(b[1], b[0]);
  const ExactNumber denominator = exactCross(edge_a, edge_b);
  const ExactNumber along = exactCross(exactDifference(b[0], a[0]), edge_b);
  const ExactPair start = exactDifference(a[0], position);
  const ExactPair r{start[0] * denominator + along * edge_a[0], start[1] * denominator + along * edge_a[1]};
  const ExactNumber height = ExactNumber(normal(0)) * r[0] + ExactNumber(normal(1)) * r[1];
  return {{quotient(r[0], denominator), quotient(r[1], denominator)},
          static_cast<double>(quotient(height, denominator))};
}

}  // namespace irradiff
