#include "verification/enclosure/area_integral.h"
#include "verification/enclosure/contour_integral.h"
#include "verification/enclosure/polar_integral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace irradiff {
namespace {

const Receiver kUpward{{0, 0, 0}, {0, 0, 1}};
const Polygon kTriangle{"triangle", {{0.9, -0.3, 1.1}, {-0.4, 0.8, 1.6}, {-0.7, -0.9, 0.8}}, 1.0};
const Polygon kStraddling{"straddling", {{1, -0.7, 0.6}, {1.2, 0.8, 0.5}, {0.9, 0.1, -0.7}}, 1.0};
// In the receiver's plane: its first edge points at the receiver.
const Polygon kRadial{"radial", {{1, 0.5, 1}, {2, 1, 2}, {1, -0.75, 1.5}}, 1.0};

Polygon reversed(Polygon polygon) {
  std::reverse(polygon.vertices.begin(), polygon.vertices.end());
  return polygon;
}

bool overlap(const FormFactorEnclosure& a, const FormFactorEnclosure& b) {
  bool all = a.value.overlaps(b.value);
  for (Eigen::Index i = 0; i < 3; ++i) {
    all = all && a.gradient(i).overlaps(b.gradient(i));
    for (Eigen::Index j = 0; j < 3; ++j) all = all && a.hessian(i, j).overlaps(b.hessian(i, j));
  }
  return all;
}

// Howell's catalogue B-3: differential element to a parallel rectangle a x b at distance c, its corner over the
// element.
Ball parallelCorner(const Ball& a, const Ball& b, const Ball& c) {
  const Ball x = a / c;
  const Ball y = b / c;
  const Ball p = sqrt(Ball(1) + x * x);
  const Ball q = sqrt(Ball(1) + y * y);
  return (x / p * atan(y / p) + y / q * atan(x / q)) / (Ball(2) * Ball::pi());
}

// Howell's catalogue B-4: the rectangle a high and b wide stands at distance c, perpendicular, its lower corner on the
// element's horizon straight ahead.
Ball perpendicularCorner(const Ball& a, const Ball& b, const Ball& c) {
  const Ball d = sqrt(a * a + c * c);
  return (atan(b / c) - c / d * atan(b / d)) / (Ball(2) * Ball::pi());
}

TEST(AreaIntegral, ParallelSquareHasTheClosedForm) {
  const Polygon square{"square", {{0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, 1}, {-0.5, -0.5, 1}}, 1.0};
  const Ball expected = Ball(4) * parallelCorner(Ball(0.5), Ball(0.5), Ball(1));
  const FormFactorEnclosure area = encloseArea(square, kUpward, 20);
  EXPECT_TRUE(area.value.overlaps(expected)) << area.value.toDecimal(30) << " " << expected.toDecimal(30);
  const FormFactorEnclosure polar = enclosePolar(square, kUpward, 40);
  EXPECT_TRUE(polar.value.overlaps(expected)) << polar.value.toDecimal(50);
  EXPECT_TRUE(polar.gradient(0).containsZero());
  EXPECT_TRUE(polar.gradient(1).containsZero());
  // Twins: no factor pi; mirrored.
  EXPECT_FALSE(area.value.overlaps(expected * Ball::pi()));
  EXPECT_FALSE(area.value.overlaps(-expected));
}

TEST(AreaIntegral, OffAxisRectangleIsASumOfCorners) {
  const Polygon rectangle{"rectangle", {{2, 0.25, 1.5}, {2, 1.75, 1.5}, {0.5, 1.75, 1.5}, {0.5, 0.25, 1.5}}, 1.0};
  const Ball c(1.5);
  const Ball expected = parallelCorner(Ball(2), Ball(1.75), c) - parallelCorner(Ball(0.5), Ball(1.75), c) -
                        parallelCorner(Ball(2), Ball(0.25), c) + parallelCorner(Ball(0.5), Ball(0.25), c);
  EXPECT_TRUE(encloseArea(rectangle, kUpward, 20).value.overlaps(expected));
  EXPECT_TRUE(enclosePolar(rectangle, kUpward, 40).value.overlaps(expected));
}

TEST(AreaIntegral, WallCutByTheHorizonIsAPerpendicularRectangle) {
  // What is below the horizon does not count, so that the closed form begins at height 0.
  const Polygon wall{"wall", {{1.25, -0.5, -0.75}, {1.25, 0.5, -0.75}, {1.25, 0.5, 1}, {1.25, -0.5, 1}}, 1.0};
  const Ball expected = Ball(2) * perpendicularCorner(Ball(1), Ball(0.5), Ball(1.25));
  EXPECT_TRUE(enclosePolar(wall, kUpward, 40).value.overlaps(expected));
  EXPECT_TRUE(encloseArea(wall, kUpward, 12).value.overlaps(expected));
}

TEST(AreaIntegral, ThreeRoutesAgree) {
  for (const Polygon& polygon : {kTriangle, kStraddling}) {
    const FormFactorEnclosure area = encloseArea(polygon, kUpward, 15);
    const FormFactorEnclosure polar = enclosePolar(polygon, kUpward, 45);
    const FormFactorEnclosure contour = differenceContour(polygon, kUpward);
    EXPECT_GE(correctDigits(area), 15) << polygon.name;
    EXPECT_GE(correctDigits(polar), 45) << polygon.name;
    EXPECT_GE(correctDigits(contour), 45) << polygon.name;
    EXPECT_TRUE(overlap(area, polar)) << polygon.name;
    EXPECT_TRUE(overlap(polar, contour)) << polygon.name;
    EXPECT_TRUE(overlap(area, contour)) << polygon.name;
  }
}

TEST(AreaIntegral, OverlapTellsOneUlpOfAVertexFromTheTruth) {
  Polygon moved = kStraddling;
  moved.vertices[1].x() = std::nextafter(moved.vertices[1].x(), 2.0);
  EXPECT_FALSE(overlap(enclosePolar(moved, kUpward, 45), differenceContour(kStraddling, kUpward)));
}

TEST(AreaIntegral, TheHorizonsMotionIsInTheHessianOfBothAreaRoutes) {
  // Of the line term, n n^T c, only the (2, 2) entry is not zero here. It is not small: without it the routes part.
  const FormFactorEnclosure area = encloseArea(kStraddling, kUpward, 12);
  FormFactorEnclosure contour = differenceContour(kStraddling, kUpward);
  ASSERT_TRUE(overlap(area, contour));
  // The cut from (1.1384.., 0.4307.., 0) to (0.9461.., -0.2692.., 0): c = 1/pi times the integral of (N.p) / (|n x N|
  // |p|^4) along it.
  const WorkingPrecision scope(200);
  const BallVector a = exactly(kStraddling.vertices[1]);
  const BallVector b = exactly(kStraddling.vertices[2]);
  const BallVector d = exactly(kStraddling.vertices[0]);
  const BallVector first = a + (b - a) * (a(2) / (a(2) - b(2)));
  const BallVector second = d + (b - d) * (d(2) / (d(2) - b(2)));
  // On the horizon N.p / |n x N| is the distance of the cut's line; with it the integral of |p|^-4 dl has a closed
  // form.
  const BallVector e = second - first;
  const Ball length_squared = e(0) * e(0) + e(1) * e(1);
  const Ball length = sqrt(length_squared);
  const Ball distance = abs(first(0) * e(1) - first(1) * e(0)) / length;
  const auto antiderivative = [&](const Ball& t) {
    return t / (Ball(2) * distance * distance * (t * t + distance * distance)) +
           atan(t / distance) / (Ball(2) * distance * distance * distance);
  };
  const Ball from = (first(0) * e(0) + first(1) * e(1)) / length;
  const Ball term = distance * (antiderivative(from + length) - antiderivative(from)) / Ball::pi();
  EXPECT_GT(term, Ball(0.01));
  contour.hessian(2, 2) -= contour.value > Ball(0) ? term : -term;
  EXPECT_FALSE(overlap(area, contour));
}

TEST(AreaIntegral, ReversingTheVerticesChangesTheSign) {
  const FormFactorEnclosure forward = enclosePolar(kStraddling, kUpward, 40);
  FormFactorEnclosure backward = enclosePolar(reversed(kStraddling), kUpward, 40);
  EXPECT_FALSE(overlap(forward, backward));
  backward.value = -backward.value;
  backward.gradient = -backward.gradient;
  backward.hessian = -backward.hessian;
  EXPECT_TRUE(overlap(forward, backward));
}

TEST(AreaIntegral, InThePlaneOfThePolygonFIsExactlyZeroAndItsGradientIsNot) {
  EXPECT_THROW(enclosePolar(kRadial, kUpward, 20), std::domain_error);
  const FormFactorEnclosure area = encloseArea(kRadial, kUpward, 12);
  EXPECT_TRUE(area.value == Ball(0));
  EXPECT_TRUE(abs(area.gradient(0)) > Ball(0.01));
  EXPECT_TRUE(overlap(area, differenceContour(kRadial, kUpward)));
}

TEST(AreaIntegral, RefusesAVertexOnTheHorizon) {
  const Polygon standing{"standing", {{1, -1, 0}, {1, 1, 0}, {1, 0, 1}}, 1.0};
  EXPECT_THROW(enclosePolar(standing, kUpward, 20), std::domain_error);
  EXPECT_THROW(encloseArea(standing, kUpward, 12), std::domain_error);
}

TEST(AreaIntegral, RefusesAReceiverOnThePolygon) {
  EXPECT_THROW(encloseArea(kTriangle, {kTriangle.vertices[0], {0, 0, 1}}, 12), std::domain_error);
}

}  // namespace
}  // namespace irradiff
