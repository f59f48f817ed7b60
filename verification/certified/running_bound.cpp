#include "verification/certified/running_bound.h"

#include "verification/certified/ball_rounding.h"

namespace irradiff {

namespace {

using Extended = RunningBound<DoubleWord<double>>;

/// Enough that only the rounding to a double word remains.
constexpr slong kExtendedBits = 128;

}  // namespace

Extended sqrt(const Extended& a) {
  const auto size = static_cast<double>(a.value());
  if (!(size > 0.0)) return {DoubleWord<double>(0.0), std::sqrt(a.rawError())};
  // Newton's step from the double, and what is left of it: |sqrt(a) - r| = |a - r^2|/(sqrt(a) + r).
  const double start = std::sqrt(size);
  const DoubleWord<double> rest = a.value() - twoProduct(start, start);
  const DoubleWord<double> root = fastTwoSum(start, rest.hi / (2.0 * start));
  const Extended residual = Extended(a.value()) - Extended(root) * Extended(root);
  return {root, (std::abs(static_cast<double>(residual.value())) + residual.rawError() + a.rawError()) / start};
}

Extended cos(const Extended& a) {
  const WorkingPrecision precision(kExtendedBits);
  return rounded<DoubleWord<double>>(cos(enclosureOf(a)));
}

Extended atan2(const Extended& y, const Extended& x) {
  const WorkingPrecision precision(kExtendedBits);
  return rounded<DoubleWord<double>>(atan2(enclosureOf(y), enclosureOf(x)));
}

}  // namespace irradiff
