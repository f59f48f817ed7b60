#include "derivatives/scene/exact_number.h"

#include "derivatives/scene/bounded_number.h"

#include <boost/multiprecision/gmp.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace irradiff {
namespace {

using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

int signOf(const Rational& value) { return (value > 0) - (value < 0); }

/// Doubles of all exponents, with few or many digits, and 0.
double drawDouble(std::mt19937_64& random) {
  std::uniform_int_distribution<int> exponent(-1074, 900);
  std::uniform_int_distribution<int> kind(0, 3);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  switch (kind(random)) {
    case 0:
      return 0.0;
    case 1:
      return std::ldexp(1.0, exponent(random));
    case 2:
      return std::round(8.0 * mantissa(random));
    default:
      return std::ldexp(mantissa(random), exponent(random));
  }
}

TEST(ExactNumber, AgreesWithRationalsOnPolynomialsOfAllMagnitudes) {
  std::mt19937_64 random(20240701);
  int zeros = 0;
  int beyond_eighth = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    ExactNumber value;
    Rational expected = 0;
    ExactNumber previous(1.0);
    Rational expected_previous = 1;
    for (int step = 0; step < 5; ++step) {
      const double a = drawDouble(random);
      const ExactNumber product = previous * ExactNumber(a);
      const Rational expected_product = expected_previous * Rational(a);
      previous = step % 2 == 0 ? product + ExactNumber(drawDouble(random)) * ExactNumber() : product - value;
      expected_previous = step % 2 == 0 ? expected_product : expected_product - expected;
      value = value - product;
      expected -= expected_product;
    }
    ASSERT_EQ(value.sign(), signOf(expected)) << trial;
    ASSERT_EQ((value + (-value)).sign(), 0);
    ASSERT_EQ((value * value - previous * value - value * (value - previous)).sign(), 0) << trial;
    zeros += expected == 0 ? 1 : 0;
    // mantissa * 2^exponent is value to within 2^-52 of it.
    const ExactNumber::Leading leading = value.leading();
    const ExactNumber rest = value - ExactNumber(leading.mantissa, leading.exponent);
    if (expected == 0) {
      ASSERT_EQ(leading.mantissa, 0.0);
      continue;
    }
    ASSERT_GE(std::abs(leading.mantissa), 0.5);
    ASSERT_LT(std::abs(leading.mantissa), 1.0);
    const ExactNumber allowed = value * ExactNumber(0x1p-52);
    ASSERT_LE(((rest * rest) - (allowed * allowed)).sign(), 0) << trial;
    // An eighth of it would not do.
    const ExactNumber eighth = value * ExactNumber(0x1p-55);
    beyond_eighth += ((rest * rest) - (eighth * eighth)).sign() > 0 ? 1 : 0;
  }
  EXPECT_GT(zeros, 100);
  EXPECT_GT(beyond_eighth, 100);
}

TEST(ExactNumber, SeesTheLastBitOfTheSmallestBesideTheLargest) {
  const ExactNumber large(std::ldexp(1.0, 1000));
  const ExactNumber small(std::ldexp(1.0, -1074));
  EXPECT_EQ((large * large + small * small - large * large).sign(), 1);
  EXPECT_EQ((large * large - small * small - large * large).sign(), -1);
  EXPECT_EQ((large * large + small * small - large * large - small * small).sign(), 0);
  EXPECT_EQ(ExactNumber().sign(), 0);
  EXPECT_EQ(ExactNumber(-0.0).sign(), 0);
}

TEST(BoundedNumber, IsCertainOfNoWrongSign) {
  std::mt19937_64 random(20240702);
  int certain = 0;
  int uncertain = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    std::vector<double> x;
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    std::uniform_int_distribution<int> digits(1, 60);
    for (int i = 0; i < 4; ++i) {
      // Numbers of few digits make determinants that vanish or nearly do.
      const int bits = digits(random);
      x.push_back(trial % 2 == 0 ? std::ldexp(std::round(std::ldexp(coordinate(random), bits)), -bits)
                                 : drawDouble(random));
    }
    x.push_back(trial % 3 == 0 ? x[0] : std::nextafter(x[0], 2.0));
    x.push_back(trial % 5 == 0 ? x[1] : std::nextafter(x[1], 2.0));
    const auto determinant = [&x]<class Number>() {
      const auto difference = [&x](std::size_t i, std::size_t j) { return Number(x[i]) - Number(x[j]); };
      return difference(0, 2) * difference(5, 3) - difference(1, 3) * difference(4, 2);
    };
    const BoundedNumber filtered = determinant.operator()<BoundedNumber>();
    const int exact = signOf(determinant.operator()<Rational>());
    ASSERT_EQ(determinant.operator()<ExactNumber>().sign(), exact) << trial;
    if (filtered.hasSign()) {
      ASSERT_EQ((filtered.value() > 0) - (filtered.value() < 0), exact) << trial;
      ++certain;
    } else {
      ++uncertain;
    }
  }
  EXPECT_GT(certain, 5000);
  EXPECT_GT(uncertain, 5000);
}

}  // namespace
}  // namespace irradiff
