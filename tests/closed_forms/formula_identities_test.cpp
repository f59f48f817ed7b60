#include "tests/closed_forms/entry_sampling.h"
#include "verification/closed_forms/closed_form_formulas.h"
#include "verification/closed_forms/closed_form_formulas_between_areas.h"
#include "verification/closed_forms/closed_forms.h"

#include <gtest/gtest.h>

#include <random>

// Identities between closed forms at 100 digits. None follows from another formula here by rewriting.

namespace irradiff::closed_forms_test {
namespace {

using Number = HundredDigits;

// 100 digits less what cancels when small rectangles are superposed.
const Number kRounding("1e-94");

class FormulaIdentities : public ::testing::Test {
 protected:
  Number draw(double lower, double upper) { return drawParameters({{"", lower, upper}}, random_).front(); }

 private:
  std::mt19937_64 random_{kSeed + 2};
};

TEST_F(FormulaIdentities, ABoxAroundTheElementSumsToOne) {
  for (int i = 0; i < parameterSets(); ++i) {
    const Number x0 = draw(-4, -0.25), x1 = draw(0.25, 4), y0 = draw(-4, -0.25), y1 = draw(0.25, 4), h = draw(0.25, 4);
    const Number zero = 0;
    const Number walls =
        perpendicularRectangle<Number>(zero, h, y0, y1, x1) + perpendicularRectangle<Number>(zero, h, y0, y1, -x0) +
        perpendicularRectangle<Number>(zero, h, x0, x1, y1) + perpendicularRectangle<Number>(zero, h, x0, x1, -y0);
    EXPECT_LT(abs(walls + parallelRectangle(x0, x1, y0, y1, h) - 1), kRounding);
    EXPECT_GT(abs(walls - 1), Number("1e-6")) << "without the ceiling the sum must miss";
  }
}

TEST_F(FormulaIdentities, TiltedRectangleContainsItsSpecialCases) {
  for (int i = 0; i < parameterSets(); ++i) {
    const Number p = draw(-4, 4), q = draw(0.125, 4), b = draw(0.125, 4), c = draw(0.125, 4);
    const Number zero = 0;
    EXPECT_LT(abs(tiltedRectangleWithTriangle(p, q, b, c, zero) - tiltedRectangle(p, q, b, c)), kRounding);
    EXPECT_LT(abs(tiltedRectangle(zero, q, b, c) - perpendicularRectangleAtCorner(q, b, c)), kRounding);
    // Wide to both sides it is a strip without end.
    const Number wide = Number("1e30");
    EXPECT_LT(abs(2 * tiltedRectangle(p, q, wide, c) - infiniteTiltedStrip(p, q, c)), Number("1e-29"));
  }
}

// In the frame of the tilted rectangle the element has another normal and F = n.V.
TEST_F(FormulaIdentities, TiltedRectangleIsTheVectorFormFactorAlongTheNormal) {
  for (int i = 0; i < parameterSets(); ++i) {
    const Number p = draw(-4, 4), q = draw(0.125, 4), b = draw(0.125, 4), c = draw(0.125, 4);
    const Number a = sqrt(p * p + q * q);
    const Number foot = c * p / a;
    const Number height = c * q / a;
    const auto vector = rectangleVectorFormFactor<Number>(-foot, a - foot, 0, b, height);
    EXPECT_LT(abs(vector[0] * q / a + vector[2] * p / a - tiltedRectangle(p, q, b, c)), kRounding);
  }
}

TEST_F(FormulaIdentities, TrianglesMakeUpRectanglesAndEachOther) {
  for (int i = 0; i < parameterSets(); ++i) {
    const Number a = draw(0.125, 4), b = draw(0.125, 4), c = draw(0.125, 4);
    EXPECT_LT(abs(parallelTriangleAtVertex(a, a, b, c) + parallelTriangleAtVertex(b, b, a, c) -
                  parallelRectangleAtCorner(a, b, c)),
              kRounding);
    EXPECT_LT(abs(regularPolygonOnAxis<Number>(4, sqrt(Number(2)) * a, c) - 4 * parallelRectangleAtCorner(a, a, c)),
              kRounding);
    // The far side of B-6 shrunk to a point at y = b leaves the standing triangle.
    const Number zero = 0;
    EXPECT_LT(abs(tiltedRectangleWithTriangle<Number>(zero, a, b, c, -a / b) - standingRightTriangle(a, b, c)),
              kRounding);
  }
}

// The disk of radius r contains the regular polygon with circumradius r and lies in the one with inradius r; F of the
// disk is r^2/(h^2 + r^2), Modest D-12. The gap closes as 1/n^2.
TEST_F(FormulaIdentities, RegularPolygonsEncloseTheDisk) {
  for (int i = 0; i < parameterSets(); ++i) {
    const Number r = draw(0.125, 4), h = draw(0.125, 4);
    const Number disk = r * r / (h * h + r * r);
    for (const int sides : {3, 4, 7, 100, 100000}) {
      const Number n = sides;
      const Number inside = regularPolygonOnAxis(n, r, h);
      const Number outside = regularPolygonOnAxis<Number>(n, r / cos(piAs<Number>() / n), h);
      EXPECT_LT(inside, disk);
      EXPECT_GT(outside, disk);
      EXPECT_LT(outside - inside, 30 * disk / (n * n));
    }
  }
}

// Uniform radiance is divergence-free away from the polygon: central differences of V at 100 digits must say so.
TEST_F(FormulaIdentities, VectorFormFactorHasNoDivergence) {
  const Number step("1e-25");
  for (int i = 0; i < parameterSets(); ++i) {
    const Number x0 = draw(0.25, 2), y0 = draw(0.25, 2), h = draw(0.25, 2), width = draw(0.25, 2),
                 height = draw(0.25, 2);
    const auto at = [&](const Number& dx, const Number& dy, const Number& dz) {
      return rectangleVectorFormFactor<Number>(x0 - dx, x0 + width - dx, y0 - dy, y0 + height - dy, h - dz);
    };
    const Number zero = 0;
    const Number xx = (at(step, zero, zero)[0] - at(-step, zero, zero)[0]) / (2 * step);
    const Number yy = (at(zero, step, zero)[1] - at(zero, -step, zero)[1]) / (2 * step);
    const Number zz = (at(zero, zero, step)[2] - at(zero, zero, -step)[2]) / (2 * step);
    // Truncation is step^2/6 times third derivatives, and those are below 1e4 at these distances.
    EXPECT_LT(abs(xx + yy + zz), Number("1e-45"));
    EXPECT_GT(abs(xx) + abs(yy) + abs(zz), Number("1e-6")) << "the parts must not vanish one by one";
  }
}

TEST_F(FormulaIdentities, AreasObeyReciprocityAndContainTheirSpecialCases) {
  for (int i = 0; i < parameterSets(); ++i) {
    const Number a = draw(0.125, 4), b = draw(0.125, 4), c = draw(0.25, 4), x = draw(0.25, 2), y = draw(-2, 2);
    const Number zero = 0;
    EXPECT_LT(abs(parallelRectangles(zero, a, zero, b, zero, a, zero, b, c) - opposedRectangles(a, b, c)), kRounding);
    EXPECT_LT(
        abs(a * perpendicularRectanglesWithCommonEdge(b, c, a) - b * perpendicularRectanglesWithCommonEdge(a, c, b)),
        kRounding);
    EXPECT_LT(abs(infinitePlatesWithCommonEdge(a, zero, b) - perpendicularInfinitePlates(b, a)), kRounding);
    // A1 F12 = A2 F21 for perpendicular rectangles of areas a b and 2 a b.
    const Number forth = perpendicularRectangles<Number>(x, x + a, y, y + b, c, c + 2 * a, zero, b);
    const Number back = perpendicularRectangles<Number>(c, c + 2 * a, zero, b, x, x + a, y, y + b);
    EXPECT_LT(abs(forth - 2 * back), kRounding);
  }
}

}  // namespace
}  // namespace irradiff::closed_forms_test
