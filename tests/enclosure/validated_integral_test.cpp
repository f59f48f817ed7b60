#include "verification/enclosure/validated_integral.h"

#include "verification/enclosure/arctangent_quotient.h"
#include "verification/enclosure/second_order_taylor.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace irradiff::enclosure {
namespace {

/// 1 / (width^2 + (x - place)^2), and x times it.
struct Peak {
  double width;
  double place;

  template <class S>
  std::array<S, 2> evaluate(const Ball& center, const S& offset) const {
    const S x = S(center) + offset;
    const S distance = S(center - Ball(place)) + offset;
    const S peak = S(1.0) / (S(Ball(width) * Ball(width)) + distance * distance);
    return {peak, x * peak};
  }
};

TEST(ValidatedIntegral, EnclosesAPeakOfAnyWidth) {
  for (const double width : {1.0, 1e-3, 1e-12, 1e-30}) {
    const auto integral = integrateUnitInterval<2>(Peak{width, 0.3});
    const Ball w(width);
    const Ball expected = (atan((Ball(1) - Ball(0.3)) / w) + atan(Ball(0.3) / w)) / w;
    EXPECT_TRUE(integral[0].overlaps(expected)) << width << ": " << integral[0].toDecimal(30);
    EXPECT_GT(integral[0].digits(), 40) << width;
    // The twin: what the enclosure is there to tell apart.
    EXPECT_FALSE(integral[0].overlaps(expected * (Ball(1) + Ball::fromDecimal("1e-40")))) << width;
  }
}

TEST(ValidatedIntegral, RefusesASingularityInTheInterval) {
  EXPECT_THROW(integrateUnitInterval<2>(Peak{0.0, 0.3}), std::runtime_error);
}

struct SquareRoot {
  template <class S>
  std::array<S, 1> evaluate(const Ball& center, const S& offset) const {
    return {sqrt(S(center + Ball(0.01)) + offset)};
  }
};

TEST(ValidatedIntegral, ABranchCutIsNotHolomorphic) {
  const ComplexBall across(Ball(-1), Ball::fromDecimal("0 +/- 0.1"));
  EXPECT_FALSE(sqrt(across).isFinite());
  EXPECT_FALSE(atan(ComplexBall(Ball::fromDecimal("0 +/- 0.1"), Ball(1.5))).isFinite());
  const auto integral = integrateUnitInterval<1>(SquareRoot{});
  const Ball end = Ball(1) + Ball(0.01);
  const Ball expected = Ball(2) / Ball(3) * (end * sqrt(end) - Ball(0.01) * sqrt(Ball(0.01)));
  EXPECT_TRUE(integral[0].overlaps(expected));
}

TEST(ArctangentQuotient, SeriesAndClosedFormMeet) {
  // Just below and above |z| = 1/2, where the evaluation changes, and in ball and complex arithmetic.
  for (const char* z : {"1e-20", "0.1", "0.4999", "0.5001", "3", "1e24"}) {
    const Ball argument = Ball::fromDecimal(z);
    const auto t = arctangentQuotient(argument);
    const Ball root = sqrt(argument);
    EXPECT_TRUE(t[0].overlaps(atan(root) / root)) << z;
    const Ball u = Ball(1) / (Ball(1) + argument);
    EXPECT_TRUE((Ball(2) * argument * t[1] + t[0]).overlaps(u)) << z;
    EXPECT_TRUE((Ball(2) * argument * t[2] + Ball(3) * t[1]).overlaps(-u * u)) << z;
    EXPECT_TRUE((Ball(2) * argument * t[3] + Ball(5) * t[2]).overlaps(Ball(2) * u * u * u)) << z;
    const auto complex = arctangentQuotient(ComplexBall(argument));
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_FALSE((ComplexBall(t[k]) - complex[k]).magnitude() > abs(t[k]) * Ball(1e-30)) << z << " order " << k;
      EXPECT_TRUE((ComplexBall(t[k]) - complex[k]).containsZero()) << z << " order " << k;
      EXPECT_GT(t[k].digits(), 40) << z << " order " << k;
    }
  }
  EXPECT_FALSE(arctangentQuotient(ComplexBall(Ball(-2), Ball::fromDecimal("0 +/- 0.1")))[0].isFinite());
}

TEST(SecondOrderTaylor, DerivativesOfAQuotientAreItsDerivatives) {
  using Taylor = SecondOrderTaylor<Ball, 2>;
  const Taylor x = Taylor::variable(Ball(3), 0);
  const Taylor y = Taylor::variable(Ball(2), 1);
  const Taylor f = x * x / y;  // 9/2; 2x/y, -x^2/y^2; 2/y, -2x/y^2, 2x^2/y^3
  const auto terms = f.terms();
  const std::array<double, 6> expected = {4.5, 3.0, -2.25, 1.0, -1.5, 2.25};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_TRUE(terms[k] == Ball(expected[k])) << k;
}

}  // namespace
}  // namespace irradiff::enclosure
