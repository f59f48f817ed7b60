#include "tests/closed_forms/adaptive_quadrature.h"
#include "verification/closed_forms/closed_form_formulas.h"
#include "verification/closed_forms/closed_form_formulas_between_areas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

// Numbers printed by others, met within half a unit of their last digit unless said otherwise.

namespace irradiff::closed_forms_test {
namespace {

// Documentation tests of the Rust crate sterad_view_factor, functions for Howell B-3 and B-4.
TEST(PublishedValues, ElementToUnitRectangle) {
  EXPECT_NEAR(static_cast<double>(parallelRectangleAtCorner<long double>(1, 1, 1)), 0.13853160599489298, 5e-17);
  EXPECT_NEAR(static_cast<double>(perpendicularRectangleAtCorner<long double>(1, 1, 1)), 0.05573419700255351, 5e-17);
}

// Engineering Equation Solver, heat transfer library: f3d_1 (Siegel and Howell, 4th edition, p. 843), f3d_14 (Howell
// C-13) and fdiff_4, the mean of Howell B-4 along a strip (Siegel and Howell, p. 843).
TEST(PublishedValues, EngineeringEquationSolver) {
  EXPECT_NEAR(static_cast<double>(opposedRectangles<long double>(1, 1.5L, 0.5L)), 0.4756, 5e-5);
  EXPECT_NEAR(
      static_cast<double>(parallelRectangles<long double>(0.1L, 0.2L, 0.1L, 0.2L, 0.1L, 0.2L, 0.1L, 0.2L, 0.05L)),
      0.4153, 5e-5);
  const Quadrature strip = integrateOverSquare(
      [](long double s, long double) { return perpendicularRectangle<long double>(0, 1, -1 - s, 1 - s, 0.5L) / 4; }, 2,
      1);
  EXPECT_NEAR(static_cast<double>(strip.value), 0.2153, 5e-5);
}

// Howell C-16, two rectangles with a common edge at 120 degrees: the catalogue's table of F12 for A1 of width B and A2
// of width A, in units of the common edge. C-16 is the mean of B-8 over A1, so the table checks B-8. It was made by
// numerical integration and its last digit is off by one in places (by six at A = 20, B = 0.1), so one unit of it is
// the bound.
constexpr double kLastDigitOfC16 = 1e-6;
constexpr std::array<double, 4> kWidths = {0.1, 0.4, 1.0, 4.0};
constexpr std::array<std::array<double, 4>, 4> kC16At120Degrees = {{{0.128098, 0.191745, 0.206687, 0.211149},
                                                                    {0.047936, 0.111512, 0.143284, 0.156919},
                                                                    {0.020669, 0.057314, 0.086615, 0.107099},
                                                                    {0.005279, 0.015692, 0.026775, 0.042260}}};

double meanOfTiltedRectangle(long double a, long double b, long double angle) {
  const long double p = a * std::cos(angle);
  const long double q = a * std::sin(angle);
  // An element sees the parts of A2 on either side of it; both have the same mean.
  const auto integrand = [&](long double s, long double t) {
    return 2 * tiltedRectangle<long double>(p, q, (1 + t) / 2, b * (1 + s) / 2) / 4;
  };
  return static_cast<double>(integrateOverSquare(integrand, b, 1, kLastDigitOfC16 * 1e-6L).value);
}

TEST(PublishedValues, TableOfC16AtAnAngleOf120Degrees) {
  const long double angle = 2 * std::numbers::pi_v<long double> / 3;
  double largest_with_other_angle = 0;
  for (std::size_t row = 0; row < kWidths.size(); ++row) {
    for (std::size_t column = 0; column < kWidths.size(); ++column) {
      const double a = kWidths[column];
      const double b = kWidths[row];
      const double printed = kC16At120Degrees[row][column];
      EXPECT_NEAR(meanOfTiltedRectangle(a, b, angle), printed, kLastDigitOfC16) << "A = " << a << ", B = " << b;
      largest_with_other_angle =
          std::max(largest_with_other_angle, std::abs(meanOfTiltedRectangle(a, b, angle * 0.9999L) - printed));
    }
  }
  EXPECT_GT(largest_with_other_angle, 10 * kLastDigitOfC16) << "the table must tell 120 degrees from 119.988";
}

}  // namespace
}  // namespace irradiff::closed_forms_test
