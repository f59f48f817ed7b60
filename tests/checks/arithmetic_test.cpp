// Arithmetic under the formulas, against 200 digits: double words, moments of arcs, Gauss rules, tangent frames.

#include "derivatives/boundary/arc_moments.h"
#include "derivatives/boundary/double_word.h"
#include "derivatives/boundary/gauss_legendre.h"
#include "derivatives/boundary/irradiance.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/comparison/error_statistics.h"
#include "verification/multiprecision/multiprecision.h"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
constexpr double kUnitRoundoff = 0x1p-53;
using Word = DoubleWord<double>;

Multiprecision exact(const Word& word) { return Multiprecision(word.hi) + Multiprecision(word.lo); }

/// |actual - expected| / |expected| in units of u^2.
double relativeError(const Word& actual, const Multiprecision& expected) {
  const Multiprecision difference = abs(exact(actual) - expected);
  return difference == 0
             ? 0.0
             : Multiprecision(difference / abs(expected)).convert_to<double>() / (kUnitRoundoff * kUnitRoundoff);
}

Word drawWord(KeyedRandom& random) {
  const double high = std::ldexp(random.between(1.0, 2.0), static_cast<int>(random.below(60)) - 30) *
                      (random.below(2) == 0 ? 1.0 : -1.0);
  const double low = std::ldexp(high * random.between(-1.0, 1.0), random.below(4) == 0 ? -80 : -53);
  return fastTwoSum(high, low);
}

TEST(DoubleWord, RelativeErrorsAreBelowThoseStated) {
  ErrorStatistics sum;
  ErrorStatistics product;
  ErrorStatistics quotient;
  std::size_t uncompensated_above = 0;
  const std::size_t count = lengthened(20000);
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(kSeed, "double words", i);
    const Word a = drawWord(random);
    Word b = drawWord(random);
    if (i % 3 == 0) {
      // Cancellation: b close to -a.
      b = -a + Word(std::ldexp(a.hi, -static_cast<int>(random.below(60))));
    }
    if (b.hi == 0.0) {
      continue;
    }
    sum.add(relativeError(a + b, exact(a) + exact(b)), i);
    product.add(relativeError(a * b, exact(a) * exact(b)), i);
    quotient.add(relativeError(a / b, exact(a) / exact(b)), i);
    uncompensated_above += relativeError(Word(a.hi * b.hi), exact(a) * exact(b)) > 10.0 ? 1 : 0;
  }
  std::cout << "peak relative errors in u^2, seed " << kSeed << ": sum " << sum.peak() << " of 3, product "
            << product.peak() << " of 5, quotient " << quotient.peak() << " of 10\n";
  // What is stated leaves out terms of u^3.
  constexpr double kHigherOrder = 1.0 + 1e-14;
  EXPECT_LE(sum.peak(), 3.0 * kHigherOrder);
  EXPECT_LE(product.peak(), 5.0 * kHigherOrder);
  EXPECT_LE(quotient.peak(), 10.0 * kHigherOrder);
  // The measure sees a product without compensation.
  EXPECT_GT(uncompensated_above, count / 2);
}

rc::Gen<double> moderate() {
  return rc::gen::map(rc::gen::pair(rc::gen::inRange<std::int64_t>(-(std::int64_t{1} << 53), std::int64_t{1} << 53),
                                    rc::gen::inRange(-60, 60)),
                      [](const std::pair<std::int64_t, int>& parts) {
                        return std::ldexp(static_cast<double>(parts.first), parts.second - 53);
                      });
}

RC_GTEST_PROP(ErrorFreeTransformations, SumAndDifferenceAreExact, ()) {
  const double a = *moderate();
  const double b = *moderate();
  RC_ASSERT(exact(twoSum(a, b)) == Multiprecision(a) + Multiprecision(b));
  RC_ASSERT(exact(twoDifference(a, b)) == Multiprecision(a) - Multiprecision(b));
  RC_ASSERT(twoSum(a, b).hi == a + b);
}

RC_GTEST_PROP(ErrorFreeTransformations, ProductIsExact, ()) {
  const double a = *moderate();
  const double b = *moderate();
  RC_ASSERT(exact(twoProduct(a, b)) == Multiprecision(a) * Multiprecision(b));
  RC_ASSERT(twoProduct(a, b).hi == a * b);
}

RC_GTEST_PROP(TangentFrame, IsOrthonormalAndRightHanded, ()) {
  const auto component = [] { return rc::gen::map(rc::gen::inRange(-1000, 1001), [](int i) { return i / 1000.0; }); };
  const Eigen::Vector3d v(*component(), *component(), *component());
  RC_PRE(v.norm() > 0.01);
  const Eigen::Vector3d n = v.normalized();
  const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(n);
  Eigen::Matrix3d basis;
  basis << frame, n;
  RC_ASSERT((basis.transpose() * basis - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 8.0 * kUnitRoundoff);
  RC_ASSERT(basis.determinant() > 0.0);
  // t is the projection of the axis least aligned with n.
  Eigen::Index axis = 0;
  n.cwiseAbs().minCoeff(&axis);
  const Eigen::Vector3d projection = Eigen::Vector3d::Unit(axis) - n(axis) * n;
  RC_ASSERT((frame.col(0) - projection.normalized()).cwiseAbs().maxCoeff() <= 8.0 * kUnitRoundoff);
}

TEST(TangentFrame, OfTheVerticalIsTheAxes) {
  const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(frame.col(0), Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(frame.col(1), Eigen::Vector3d(0.0, 1.0, 0.0));
}

TEST(TangentialHessian, IsTheRestrictionToTheFrame) {
  KeyedRandom random(kSeed, "tangential Hessian", 0);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d n = random.direction();
    Eigen::Matrix3d h = random.direction() * random.direction().transpose();
    h = (h + h.transpose()).eval();
    const Eigen::Matrix<double, 3, 2> frame = tangentFrame<double>(n);
    EXPECT_LE((tangentialHessian<double>(h, n).value - frame.transpose() * h * frame).cwiseAbs().maxCoeff(),
              32.0 * kUnitRoundoff);
  }
}

template <class Scalar>
std::array<Scalar, 5> listed(const ArcMoments<Scalar>& m) {
  return {m.aa, m.ab, m.aaaa, m.aaab, m.aabb};
}

/// The peak relative error over angles up to `largest`, in units of u.
double peakOfMoments(double smallest, double largest) {
  ErrorStatistics errors;
  const std::size_t count = lengthened(2000);
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(kSeed, "moments", i);
    const double angle = i % 2 == 0 ? random.between(smallest, largest)
                                    : std::exp(random.between(std::log(std::max(smallest, 1e-9)), std::log(largest)));
    const auto actual = listed(arcMoments(angle));
    const auto expected = listed(arcMoments(Multiprecision(angle)));
    for (std::size_t k = 0; k < actual.size(); ++k) {
      errors.add(Multiprecision(abs(actual[k] - expected[k]) / expected[k]).convert_to<double>() / kUnitRoundoff, i);
    }
  }
  std::cout << "moments of arcs of " << smallest << " to " << largest << " rad: peak " << errors.peak() << " u, rms "
            << errors.rootMeanSquare() << " u\n";
  return errors.peak();
}

TEST(ArcMoments, AreAsAccurateAsStated) {
  EXPECT_LE(peakOfMoments(0.0, 1.0), 3.5);
  EXPECT_LE(peakOfMoments(1.0, 2.0), 17.3);
}

TEST(ArcMoments, OfNoArcAreThoseOfAStraightEdge) {
  const auto moments = listed(arcMoments(0.0));
  const std::array<double, 5> straight = {1.0 / 3.0, 1.0 / 6.0, 1.0 / 5.0, 1.0 / 20.0, 1.0 / 30.0};
  for (std::size_t k = 0; k < straight.size(); ++k) {
    EXPECT_DOUBLE_EQ(moments[k], straight[k]);
  }
}

/// The closed forms that the series are compared with, against the means that define them.
TEST(ArcMoments, ClosedFormsAreTheMeans) {
  for (const double angle : {0.01, 0.3, 1.0, 1.7, 2.0}) {
    const auto closed = listed(arcMoments(Multiprecision(angle)));
    const auto mean = [angle](int a_power, int b_power) {
      const long double length = angle;
      const long double integral = boost::math::quadrature::gauss<long double, 30>::integrate(
          [&](long double phi) {
            const long double a = std::sin(length - phi) / std::sin(length);
            const long double b = std::sin(phi) / std::sin(length);
            return std::pow(a, a_power) * std::pow(b, b_power);
          },
          0.0L, length);
      return integral / length;
    };
    const std::array<std::array<int, 2>, 5> powers = {{{2, 0}, {1, 1}, {4, 0}, {3, 1}, {2, 2}}};
    for (std::size_t k = 0; k < powers.size(); ++k) {
      const long double expected = mean(powers[k][0], powers[k][1]);
      // 30 positive terms and a handful of roundings in each.
      EXPECT_LE(std::abs(closed[k].convert_to<long double>() - expected), 64.0L * 0x1p-64L * expected)
          << "moment " << k << " at " << angle;
      EXPECT_LE(std::abs(closed[k].convert_to<long double>() - mean(powers[k][1], powers[k][0])),
                64.0L * 0x1p-64L * expected);
    }
  }
}

TEST(GaussLegendre, IntegratesPolynomialsOfDegreeBelowTwiceItsNodes) {
  for (std::size_t count = 1; count <= kMostGaussNodes; ++count) {
    const GaussLegendreRule& rule = gaussLegendre(count);
    ASSERT_EQ(rule.nodes.size(), count);
    const auto error = [&rule](std::size_t degree) {
      Multiprecision sum = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        Multiprecision power = rule.weights[i];
        for (std::size_t k = 0; k < degree; ++k) {
          power *= rule.nodes[i];
        }
        sum += power;
      }
      return abs(Multiprecision(sum * (degree + 1) - 1)).convert_to<double>();
    };
    for (std::size_t degree = 0; degree < 2 * count; ++degree) {
      // Each node, to the power, and each weight is off by at most an ulp, 2 u.
      EXPECT_LE(error(degree), 2.0 * kUnitRoundoff * static_cast<double>(degree + 1)) << count << " nodes";
    }
    // One degree more is not exact: the error is n!^4 / ((2n)!^2) there, relative to 1.
    if (count <= 10) {
      const double binomial = std::tgamma(2.0 * static_cast<double>(count) + 1.0) /
                              std::pow(std::tgamma(static_cast<double>(count) + 1.0), 2.0);
      EXPECT_NEAR(error(2 * count) * binomial * binomial, 1.0, 1e-3) << count << " nodes";
    }
  }
}

}  // namespace
}  // namespace irradiff
