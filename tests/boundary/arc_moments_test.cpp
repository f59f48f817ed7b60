// The moments of arcs: the count of their rounding errors by machine, docs/derivations/error_bounds.md, section 2.3.
// Their errors against 200 digits are measured in tests/checks/arithmetic_test.cpp.

#include "derivatives/boundary/arc_moments.h"

#include "tests/boundary/tracked_scalar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

namespace irradiff {
namespace {

/// The largest count among the five moments over angles in (low, high], the angle itself being exact, in units of u.
template <class Scalar>
double largestCount(double low, double high) {
  constexpr int kSteps = 400;
  double largest = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const ErrorTape tape;
    const double angle = low + (high - low) * static_cast<double>(i) / kSteps;
    const ArcMoments<Scalar> m = arcMoments(Scalar::input(angle));
    for (const Scalar* moment : {&m.aa, &m.ab, &m.aaaa, &m.aaab, &m.aabb}) {
      largest = std::max(largest, moment->worstError() / static_cast<double>(moment->value()));
    }
  }
  std::cout << "moments of arcs of " << low << " to " << high << " rad: count " << largest << " u\n";
  return largest;
}

/// What the documentation states includes 1 for the coefficients of the series, which are rounded themselves.
constexpr double kSeriesCoefficients = 1.0;

TEST(ArcMomentsCount, OfTheSeriesIsBelowTheOneStated) {
  EXPECT_LE(largestCount<Tracked>(0.0, 1.0) + kSeriesCoefficients, 3.6);
}

TEST(ArcMomentsCount, OfTheDoubledSeriesIsBelowTheOneStated) {
  EXPECT_LE(largestCount<Tracked>(1.0, 2.0) + kSeriesCoefficients, 18.2);
}

TEST(ArcMomentsCount, OfTheClosedFormsIsNot) {
  EXPECT_GT(largestCount<TrackedClosedForms>(1.0, 1.1), 18.2);
  EXPECT_GT(largestCount<TrackedClosedForms>(0.09, 0.1), 1e4);
}

}  // namespace
}  // namespace irradiff
