#include "experiments/cache_2d/interval_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace irradiff {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Up to the distance d0 of its first place the error c d^2.
const SideError kQuadratic{{2.0}, {4.0}};
const SideError kNothing{{5.0}, {0.0}};
/// Quadratic to 1, 0 to 3, and from there 6 up to 4.
const SideError kStep{{1.0, 1.0, 3.0, 3.0, 4.0}, {0.75, 0.0, 0.0, 6.0, 6.0}};

double lengthOf(const SideError& before, const SideError& after, double threshold,
                ErrorMeasure measure = ErrorMeasure::kTotal) {
  return intervalOfError(before, after, threshold, measure);
}

TEST(IntervalOfError, KeepsTheTotalAtTheThreshold) {
  // The integral of d^2 to R is R^3/3, from both sides twice that.
  EXPECT_NEAR(lengthOf(kQuadratic, kNothing, 1.0 / 3.0), 1.0, 1e-15);
  EXPECT_NEAR(lengthOf(kQuadratic, kQuadratic, 2.0 / 3.0), 1.0, 1e-15);
  EXPECT_EQ(lengthOf(kQuadratic, kQuadratic, 6.0), kInfinity) << "16/3 at most";
  EXPECT_EQ(lengthOf(kNothing, kNothing, 1e-300), kInfinity);
  EXPECT_NEAR(lengthOf(kNothing, kStep, 0.25 + 3.0), 3.5, 1e-14);
  EXPECT_NEAR(lengthOf(kStep, kNothing, 0.25 / 8.0), 0.5, 1e-15);
  EXPECT_LT(lengthOf(kQuadratic, kNothing, 0.0), 1e-100);
}

TEST(IntervalOfError, KeepsTheMeanAtTheThreshold) {
  // R^3/3 over 2 R.
  EXPECT_NEAR(lengthOf(kQuadratic, kNothing, 1.0 / 6.0, ErrorMeasure::kMean), 1.0, 1e-15);
  EXPECT_EQ(lengthOf(kQuadratic, kNothing, 1.0, ErrorMeasure::kMean), kInfinity);
}

TEST(IntervalOfError, IsTheInverseOfTheIntegral) {
  for (const double length : {0.1, 0.9, 1.7, 2.5, 3.2, 3.9}) {
    const double error = integratedError(kQuadratic, kStep, length);
    if (length < 2.0 || length > 3.0) {
      EXPECT_NEAR(lengthOf(kQuadratic, kStep, error), length, 1e-13);
    } else {
      EXPECT_GE(lengthOf(kQuadratic, kStep, error * (1.0 + 1e-15)), 3.0 - 1e-13) << "nothing is wrong from 2 to 3";
    }
  }
  EXPECT_NEAR(integratedError(kNothing, kStep, 100.0), 6.25, 1e-15);
}

}  // namespace
}  // namespace irradiff
