// Directions and weights of strata against the textbook formulas at 200 digits, to the last strata of the finest grids.

#include "derivatives/samples/strata.h"
#include "verification/comparison/error_statistics.h"
#include "verification/multiprecision/multiprecision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <random>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using Number = Multiprecision;

constexpr double kUnitRoundoff = 0x1p-53;

Number pi200() { return 2 * acos(Number(0)); }

Number across(std::size_t index, double along, std::size_t count) { return (Number(index) + Number(along)) / count; }

/// Ward and Heckbert 1992: the azimuth and the square of the polar angle's sine are uniform.
MultiprecisionVector polarReference(const GridShape& shape, const StratumPosition& p) {
  const Number azimuth = 2 * pi200() * across(p.column, p.along_row, shape.columns);
  const Number sine_squared = across(p.row, p.along_column, shape.rows);
  return {sqrt(sine_squared) * cos(azimuth), sqrt(sine_squared) * sin(azimuth), sqrt(1 - sine_squared)};
}

/// Shirley and Chiu 1997, in their four regions.
MultiprecisionVector concentricReference(const GridShape& shape, const StratumPosition& p) {
  const Number a = 2 * across(p.column, p.along_row, shape.columns) - 1;
  const Number b = 2 * across(p.row, p.along_column, shape.rows) - 1;
  Number r, phi;
  if (a > -b) {
    if (a > b) {
      r = a;
      phi = pi200() / 4 * (b / a);
    } else {
      r = b;
      phi = pi200() / 4 * (2 - a / b);
    }
  } else if (a < b) {
    r = -a;
    phi = pi200() / 4 * (4 + b / a);
  } else {
    r = -b;
    phi = r == 0 ? Number(0) : Number(pi200() / 4 * (6 - a / b));
  }
  return {r * cos(phi), r * sin(phi), sqrt(1 - r * r)};
}

MultiprecisionVector hemicubeReference(const GridShape& shape, const StratumPosition& p) {
  const std::size_t n = shape.columns;
  const Number x = 2 * across(p.column, p.along_row, n) - 1;
  MultiprecisionVector v;
  if (p.row < n) {
    v = {x, 2 * across(p.row, p.along_column, n) - 1, Number(1)};
  } else {
    const Number z = across((p.row - n) % (n / 2), p.along_column, n / 2);
    const std::size_t face = (p.row - n) / (n / 2);
    if (face == 0) v = {Number(1), x, z};
    if (face == 1) v = {-x, Number(1), z};
    if (face == 2) v = {Number(-1), -x, z};
    if (face == 3) v = {x, Number(-1), z};
  }
  return v / sqrt(v.dot(v));
}

using ReferenceMap = std::function<MultiprecisionVector(const GridShape&, const StratumPosition&)>;
using Map = std::function<Vector3d(const StratumPosition&)>;

struct DirectionErrors {
  ErrorStatistics tangential;  ///< absolute
  ErrorStatistics height;      ///< relative to n
  ErrorStatistics length;      ///< of 1
};

/// At random places, every other one close to a border of its stratum, in strata anywhere and on the grid's outline.
DirectionErrors directionErrors(const Map& map, const ReferenceMap& reference, const GridShape& shape) {
  std::mt19937_64 random(42);
  std::uniform_int_distribution<std::size_t> row(0, shape.rows - 1), column(0, shape.columns - 1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  DirectionErrors errors;
  for (std::size_t i = 0; i < 4000; ++i) {
    StratumPosition p{row(random), column(random), unit(random), unit(random)};
    if (i % 4 == 1) p.column = 0;
    if (i % 4 == 2) p.row = shape.rows - 1;
    if (i % 3 == 1) p.along_row = std::ldexp(p.along_row, -static_cast<int>(i % 60));
    if (i % 5 == 1) p.along_column = 1.0 - std::ldexp(p.along_column, -static_cast<int>(i % 53));
    const Vector3d d = map(p);
    const MultiprecisionVector exact = reference(shape, p);
    const MultiprecisionVector difference = withoutRounding(d) - exact;
    errors.tangential.add(std::max(abs(difference.x()), abs(difference.y())).convert_to<double>(), i);
    if (exact.z() > 0) errors.height.add(Number(abs(difference.z()) / exact.z()).convert_to<double>(), i);
    errors.length.add(abs(sqrt(withoutRounding(d).dot(withoutRounding(d))) - 1).convert_to<double>(), i);
  }
  return errors;
}

void print(const std::string& name, const ErrorStatistics& errors, double bound) {
  std::cout << name << ": peak " << errors.peak() / kUnitRoundoff << " u, RMS "
            << errors.rootMeanSquare() / kUnitRoundoff << " u, bound " << bound / kUnitRoundoff << " u, input "
            << errors.worstInput() << '\n';
}

// n = sqrt(c d) with c and d of two or three roundings each.
constexpr double kHeightError = 5 * kUnitRoundoff;
// The azimuth is 4 k / columns quarter turns with two roundings: 8 u pi/2 at the end of the turn, and what cosine,
// radius and their product add.
constexpr double kTangentialError = 20 * kUnitRoundoff;

struct AccuracyCase {
  Stratification stratification;
  ReferenceMap reference;
  std::vector<GridShape> shapes;
};

std::vector<AccuracyCase> accuracyCases() {
  return {{Stratification::kPolar, polarReference, {{1, 1}, {7, 3}, {64, 64}, {65536, 65536}}},
          {Stratification::kConcentric, concentricReference, {{1, 1}, {3, 5}, {64, 64}, {65535, 65536}}},
          {Stratification::kHemicube, hemicubeReference, {{6, 2}, {96, 32}, {65532, 21844}}}};
}

TEST(StrataAccuracy, DirectionsAreRightToRounding) {
  for (const AccuracyCase& entry : accuracyCases()) {
    for (const GridShape& shape : entry.shapes) {
      const Strata strata(entry.stratification, shape);
      const DirectionErrors errors =
          directionErrors([&](const StratumPosition& p) { return strata.direction(p); }, entry.reference, shape);
      const std::string name = std::to_string(static_cast<int>(entry.stratification)) + ", " +
                               std::to_string(shape.rows) + " x " + std::to_string(shape.columns);
      print(name + " t and b", errors.tangential, kTangentialError);
      print(name + " n", errors.height, kHeightError);
      print(name + " length", errors.length, kHeightError);
      EXPECT_LE(errors.tangential.peak(), kTangentialError) << name;
      EXPECT_LE(errors.height.peak(), kHeightError) << name;
      EXPECT_LE(errors.length.peak(), kHeightError) << name;
    }
  }
}

TEST(StrataAccuracy, AHeightThatLosesDigitsAtTheHorizonIsNoticed) {
  for (const AccuracyCase& entry : accuracyCases()) {
    const GridShape shape = entry.shapes.back();
    const Strata strata(entry.stratification, shape);
    const Map textbook = [&](const StratumPosition& p) -> Vector3d {
      const Vector3d d = strata.direction(p);
      return {d.x(), d.y(), std::sqrt(std::max(0.0, 1.0 - d.x() * d.x() - d.y() * d.y()))};
    };
    EXPECT_GT(directionErrors(textbook, entry.reference, shape).height.peak(), 1000 * kHeightError);
  }
}

// ------------------------------------------------------------------------------------------------------------- weights

/// An integral over a rectangle from its primitive at the corners. At 200 digits the differences cost nothing.
template <class Scalar, class Primitive>
Scalar cornerDifference(Primitive primitive, Scalar x0, Scalar x1, Scalar y0, Scalar y1) {
  return primitive(x1, y1) - primitive(x0, y1) - primitive(x1, y0) + primitive(x0, y0);
}

template <class Scalar>
Scalar topFacePrimitive(Scalar x, Scalar y) {
  const Scalar c = sqrt(1 + x * x);
  const Scalar d = sqrt(1 + y * y);
  return (x / c * atan(y / c) + y / d * atan(x / d)) / 2;
}

template <class Scalar>
Scalar halfFacePrimitive(Scalar y, Scalar z) {
  const Scalar c = sqrt(1 + z * z);
  return -atan(y / c) / c / 2;
}

template <class Scalar>
Scalar solidAnglePrimitive(Scalar x, Scalar y) {
  return atan(x * y / sqrt(1 + x * x + y * y));
}

/// The integral of pi/4 / sqrt(1 - max(a, b)^2) from the middle of the square to a corner, odd in both.
template <class Scalar>
Scalar concentricPrimitive(Scalar x, Scalar y) {
  const Scalar a = abs(x), b = abs(y);
  const Scalar low = a < b ? a : b, high = a < b ? b : a;
  const Scalar size = 2 * (1 - sqrt(1 - low * low)) + low * (asin(high) - asin(low));
  return (x * y < 0 ? -size : size) * acos(Scalar(-1)) / 4;
}

template <class Scalar>
Scalar border(std::size_t index, std::size_t count) {
  return 2 * Scalar(index) / Scalar(count) - 1;
}

template <class Scalar>
struct TexelWeights {
  Scalar projected, solid;
};

template <class Scalar>
TexelWeights<Scalar> hemicubeReferenceWeights(const GridShape& shape, std::size_t row, std::size_t column) {
  const std::size_t n = shape.columns;
  const Scalar x0 = border<Scalar>(column, n), x1 = border<Scalar>(column + 1, n);
  if (row < n) {
    const Scalar y0 = border<Scalar>(row, n), y1 = border<Scalar>(row + 1, n);
    return {cornerDifference<Scalar>(topFacePrimitive<Scalar>, x0, x1, y0, y1),
            cornerDifference<Scalar>(solidAnglePrimitive<Scalar>, x0, x1, y0, y1)};
  }
  const std::size_t half_row = n / 2 + (row - n) % (n / 2);
  const Scalar z0 = border<Scalar>(half_row, n), z1 = border<Scalar>(half_row + 1, n);
  return {cornerDifference<Scalar>(halfFacePrimitive<Scalar>, x0, x1, z0, z1),
          cornerDifference<Scalar>(solidAnglePrimitive<Scalar>, x0, x1, z0, z1)};
}

template <class Scalar>
Scalar concentricReferenceSolidAngle(const GridShape& shape, std::size_t row, std::size_t column) {
  return cornerDifference<Scalar>(concentricPrimitive<Scalar>, border<Scalar>(column, shape.columns),
                                  border<Scalar>(column + 1, shape.columns), border<Scalar>(row, shape.rows),
                                  border<Scalar>(row + 1, shape.rows));
}

template <class Scalar>
Scalar polarReferenceSolidAngle(const GridShape& shape, std::size_t row) {
  const auto height = [&](std::size_t i) { return sqrt(1 - Scalar(i) / Scalar(shape.rows)); };
  return 2 * acos(Scalar(-1)) * (height(row) - height(row + 1)) / Scalar(shape.columns);
}

/// Strata in every part of a grid: all if it is small, else random ones, some of them on the outline, in the middle and
/// on the diagonal.
std::vector<std::pair<std::size_t, std::size_t>> chosenStrata(const GridShape& shape) {
  std::vector<std::pair<std::size_t, std::size_t>> chosen;
  if (shape.size() <= 1600) {
    for (std::size_t k = 0; k < shape.size(); ++k) chosen.emplace_back(k / shape.columns, k % shape.columns);
    return chosen;
  }
  std::mt19937_64 random(5);
  std::uniform_int_distribution<std::size_t> row(0, shape.rows - 1), column(0, shape.columns - 1);
  for (std::size_t i = 0; i < 1600; ++i) {
    const std::size_t r = row(random), c = column(random);
    const std::size_t diagonal = c * shape.rows / shape.columns;
    if (i % 8 < 3) chosen.emplace_back(r, c);
    if (i % 8 == 3) chosen.emplace_back(i % 16 < 8 ? 0 : shape.rows - 1, c);
    if (i % 8 == 4) chosen.emplace_back(r, i % 16 < 8 ? 0 : shape.columns - 1);
    if (i % 8 == 5) chosen.emplace_back((shape.rows - 1) / 2, c);
    if (i % 8 == 6) chosen.emplace_back(diagonal, c);
    if (i % 8 == 7) chosen.emplace_back(shape.rows - 1 - diagonal, c);
  }
  return chosen;
}

using Weight = std::function<double(std::size_t, std::size_t)>;
using ReferenceWeight = std::function<Number(std::size_t, std::size_t)>;

ErrorStatistics weightErrors(const Weight& weight, const ReferenceWeight& reference, const GridShape& shape) {
  ErrorStatistics errors;
  for (const auto& [row, column] : chosenStrata(shape)) {
    const Number exact = reference(row, column);
    errors.add(abs((Number(weight(row, column)) - exact) / exact).convert_to<double>(), row * shape.columns + column);
  }
  return errors;
}

// A weight is a quotient of about a dozen rounded factors, or the sum of two such of one sign.
constexpr double kWeightError = 24 * kUnitRoundoff;

void expectWeights(const std::string& name, const Weight& weight, const ReferenceWeight& reference,
                   const GridShape& shape) {
  const ErrorStatistics errors = weightErrors(weight, reference, shape);
  print(name + " " + std::to_string(shape.rows) + " x " + std::to_string(shape.columns), errors, kWeightError);
  EXPECT_LE(errors.peak(), kWeightError) << name;
}

TEST(StrataAccuracy, WeightsOfTexelsAreRightToRoundingAtEveryResolution) {
  for (const std::size_t n : {2, 4, 6, 32, 1000, 21844}) {
    const GridShape shape{3 * n, n};
    const Strata strata(Stratification::kHemicube, shape);
    expectWeights(
        "hemicube, projected", [&](std::size_t r, std::size_t c) { return strata.projectedSolidAngle(r, c); },
        [&](std::size_t r, std::size_t c) { return hemicubeReferenceWeights<Number>(shape, r, c).projected; }, shape);
    expectWeights(
        "hemicube, solid angle", [&](std::size_t r, std::size_t c) { return strata.solidAngle(r, c); },
        [&](std::size_t r, std::size_t c) { return hemicubeReferenceWeights<Number>(shape, r, c).solid; }, shape);
  }
}

TEST(StrataAccuracy, SolidAnglesOfEqualAreaStrataAreRightToRounding) {
  for (const GridShape& shape : std::vector<GridShape>{
           {1, 1}, {1, 2}, {2, 1}, {3, 3}, {5, 7}, {64, 64}, {3, 65536}, {65535, 65536}, {65536, 65536}}) {
    const Strata concentric(Stratification::kConcentric, shape);
    expectWeights(
        "concentric", [&](std::size_t r, std::size_t c) { return concentric.solidAngle(r, c); },
        [&](std::size_t r, std::size_t c) { return concentricReferenceSolidAngle<Number>(shape, r, c); }, shape);
    const Strata polar(Stratification::kPolar, shape);
    expectWeights(
        "polar", [&](std::size_t r, std::size_t c) { return polar.solidAngle(r, c); },
        [&](std::size_t r, std::size_t) { return polarReferenceSolidAngle<Number>(shape, r); }, shape);
  }
}

TEST(StrataAccuracy, DifferencesOfPrimitivesInDoubleAreNoticed) {
  const GridShape cube{3000, 1000};
  const auto exact = [&](std::size_t r, std::size_t c) {
    return hemicubeReferenceWeights<Number>(cube, r, c).projected;
  };
  const auto rounded = [&](std::size_t r, std::size_t c) {
    return hemicubeReferenceWeights<double>(cube, r, c).projected;
  };
  EXPECT_GT(weightErrors(rounded, exact, cube).peak(), 100 * kWeightError);
  const GridShape square{1000, 1000};
  EXPECT_GT(
      weightErrors([&](std::size_t r, std::size_t c) { return concentricReferenceSolidAngle<double>(square, r, c); },
                   [&](std::size_t r, std::size_t c) { return concentricReferenceSolidAngle<Number>(square, r, c); },
                   square)
          .peak(),
      100 * kWeightError);
}

}  // namespace
}  // namespace irradiff
