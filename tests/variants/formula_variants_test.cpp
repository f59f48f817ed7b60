#include "verification/variants/formula_variants.h"

#include "verification/checks/input_families.h"
#include "verification/checks/oracle.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20261126;

double unitRoundoff(ScalarType scalar) {
  switch (scalar) {
    case ScalarType::kFloat:
      return std::numeric_limits<float>::epsilon() / 2.0;
    case ScalarType::kDouble:
      return std::numeric_limits<double>::epsilon() / 2.0;
    default:
      return static_cast<double>(std::numeric_limits<long double>::epsilon()) / 2.0;
  }
}

template <class Actual, class Expected>
double normwiseError(const Actual& actual, const Expected& expected) {
  Multiprecision error = 0;
  Multiprecision size = 0;
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    if (!std::isfinite(actual(i))) return std::numeric_limits<double>::infinity();
    error = std::max<Multiprecision>(error, abs(Multiprecision(actual(i)) - expected(i)));
    size = std::max<Multiprecision>(size, abs(expected(i)));
  }
  return Multiprecision(error / size).convert_to<double>();
}

/// The worst of F, gradient and Hessian.
double worstError(const FormFactor<long double>& actual, const OracleValue& expected) {
  using One = Eigen::Matrix<long double, 1, 1>;
  using ExpectedOne = Eigen::Matrix<Multiprecision, 1, 1>;
  return std::max({normwiseError(One(actual.value), ExpectedOne(expected.form_factor)),
                   normwiseError(actual.gradient, expected.gradient), normwiseError(actual.hessian, expected.hessian)});
}

/// A polygon of a fifth of its distance, with coordinates and normal that floats hold: the least of the sizes at which
/// the edge sums are at ease and the area rule is exact.
Configuration drawMiddling(KeyedRandom& random) {
  const auto rounded = [](double v) { return std::ldexp(std::round(std::ldexp(v, 16)), -16); };
  const Eigen::Vector3d centre(rounded(random.between(-0.3, 0.3)), rounded(random.between(-0.3, 0.3)), 1.0);
  const double size = random.between(0.15, 0.25);
  Configuration input;
  input.polygon.radiance = 1.0;
  const std::size_t count = 3 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = -2.0 * M_PI * (static_cast<double>(i) + random.between(-0.2, 0.2)) / static_cast<double>(count);
    const double x = rounded(size * std::cos(turn));
    const double y = rounded(size * std::sin(turn));
    input.polygon.vertices.emplace_back(centre + Eigen::Vector3d(x, y, 0.5 * x - 0.25 * y));
  }
  input.receiver = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
  return input;
}

double allowed(const FormulaVariant& variant) {
  // Away from the extremes every form keeps all but four digits of its scalar: the third power of distance over edge,
  // and the roundings of a sum of terms that cancel. 8 x 8 nodes have a quadrature error of their own: seen from the
  // middle of a line of nodes, the kernel's poles are at least four times as far as its ends (rho > 4), so that it is
  // about 4^-16.
  const double rounding = 2e4 * unitRoundoff(variant.scalar);
  return variant.formula == "area rule" ? rounding + 0x1p-32 : rounding;
}

class EveryVariant : public testing::TestWithParam<FormulaVariant> {};

TEST_P(EveryVariant, ComputesFormFactorGradientAndHessian) {
  const Oracle oracle = multiprecisionOracle();
  double peak = 0.0;
  for (std::size_t i = 0; i < 100; ++i) {
    KeyedRandom random(kSeed, "formula variants", i);
    Configuration input = drawMiddling(random);
    for (int side = 0; side < 2; ++side) {
      const FormFactor<long double> actual = GetParam().evaluate(input.polygon, input.receiver);
      const double error = worstError(actual, oracle.evaluate(input).value());
      EXPECT_LE(error, allowed(GetParam())) << sceneLine(input);
      peak = std::max(peak, error);
      std::reverse(input.polygon.vertices.begin(), input.polygon.vertices.end());
    }
  }
  // A float variant must not be a double in disguise, and so on.
  EXPECT_GT(peak, 0.5 * unitRoundoff(GetParam().scalar));
}

TEST_P(EveryVariant, IsToldFromOneThatIsOffByMoreThanItsScalar) {
  const Oracle oracle = multiprecisionOracle();
  KeyedRandom random(kSeed, "formula variants", 0);
  const Configuration input = drawMiddling(random);
  FormFactor<long double> twin = GetParam().evaluate(input.polygon, input.receiver);
  twin.hessian(2, 1) *= 1.01L;
  EXPECT_GT(worstError(twin, oracle.evaluate(input).value()), allowed(GetParam()));
}

TEST_P(EveryVariant, SurvivesAReceiverOnAnEdge) {
  const Polygon polygon{"on its edge", {{-1, 0, 0}, {1, 0, 0}, {0, 1, 1}}, 1.0};
  EXPECT_NO_THROW(GetParam().evaluate(polygon, {{0, 0, 0}, {0, 0, 1}}));
}

INSTANTIATE_TEST_SUITE_P(Formulas, EveryVariant, testing::ValuesIn(formulaVariants()), [](const auto& parameter) {
  std::string name = parameter.param.name();
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
});

TEST(FormulaVariants, AreNamedOnceAndStartWithTheAppendixInDouble) {
  std::set<std::string> names;
  for (const FormulaVariant& variant : formulaVariants()) EXPECT_TRUE(names.insert(variant.name()).second);
  EXPECT_EQ(formulaVariants().front().name(), "appendix, acos, double");
}

}  // namespace
}  // namespace irradiff
