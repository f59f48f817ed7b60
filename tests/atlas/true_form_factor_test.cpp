#include "experiments/atlas/true_form_factor.h"

#include "experiments/atlas/polygon_map.h"
#include "verification/checks/random.h"
#include "verification/enclosure/polar_integral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr int kDigits = 20;

Multiprecision midpoint(const Ball& ball) { return Multiprecision(ball.midpointToDecimal(40)); }

/// Whether each value is within 1e-19 of its quantity's largest component from the enclosure of the defining integral.
bool agrees(const FormFactor<Multiprecision>& f, const FormFactorEnclosure& enclosure) {
  const Multiprecision tolerance("1e-19");
  Multiprecision gradient_size = 0;
  Multiprecision hessian_size = 0;
  for (int i = 0; i < 3; ++i) {
    gradient_size = std::max<Multiprecision>(gradient_size, abs(f.gradient(i)));
    for (int j = 0; j < 3; ++j) hessian_size = std::max<Multiprecision>(hessian_size, abs(f.hessian(i, j)));
  }
  bool all = abs(f.value - midpoint(enclosure.value)) <= tolerance * abs(f.value);
  for (int i = 0; i < 3; ++i) {
    all = all && abs(f.gradient(i) - midpoint(enclosure.gradient(i))) <= tolerance * gradient_size;
    for (int j = 0; j < 3; ++j) {
      all = all && abs(f.hessian(i, j) - midpoint(enclosure.hessian(i, j))) <= tolerance * hessian_size;
    }
  }
  return all;
}

// The enclosure shares nothing with either formula.
TEST(TrueFormFactor, IsThatOfTheDefiningIntegral) {
  for (const PolygonMap& map : polygonMaps()) {
    for (std::size_t i = 0; i < 3; ++i) {
      KeyedRandom random(7, map.file, i);
      const double x = map.x.low * std::pow(map.x.high / map.x.low, random.between(0.4, 0.9));
      const double y = map.y.low * std::pow(map.y.high / map.y.low, random.between(0.4, 0.9));
      const Configuration input = map.draw(random, x, y);
      const FormFactorEnclosure enclosure = enclosePolar(input.polygon, input.receiver, kDigits);
      EXPECT_TRUE(agrees(trueFormFactor(input), enclosure)) << sceneLine(input);
      Configuration moved = input;
      moved.receiver.position += 1e-14 * (input.polygon.vertices[0] - input.receiver.position);
      EXPECT_FALSE(agrees(trueFormFactor(moved), enclosure)) << "the bad twin of " << sceneLine(input);
    }
  }
}

// One of its formulas knows no horizon: what they do not agree on is no truth.
TEST(TrueFormFactor, IsNoneWhereItsFormulasDiffer) {
  const Configuration input{{"sinks", {{-1, 0, 1}, {1, 0, 1}, {0, 1, -1}}, 1.0}, {{0, 0, 0}, {0, 0, 1}}};
  EXPECT_THROW(trueFormFactor(input), std::logic_error);
}

TEST(RelativeErrors, AreOfTheLargestComponent) {
  FormFactor<Multiprecision> truth{2, MultiprecisionVector(0, 4, 1), MultiprecisionMatrix::Constant(8)};
  FormFactor<long double> actual{3.0L, {1.0L, 4.0L, 1.0L}, Matrix3<long double>::Constant(8.0L)};
  EXPECT_EQ(relativeErrors(actual, truth), (AtlasErrors{0.5, 0.25, 0.0}));
  actual.hessian(2, 0) = std::numeric_limits<long double>::quiet_NaN();
  EXPECT_EQ(relativeErrors(actual, truth), (AtlasErrors{0.5, 0.25, std::numeric_limits<double>::infinity()}));
}

}  // namespace
}  // namespace irradiff
