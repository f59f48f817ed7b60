#include "verification/enclosure/flatland_integral.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace irradiff {
namespace {

void expectOverlap(const FlatlandEnclosure& a, const FlatlandEnclosure& b) {
  EXPECT_TRUE(a.value.overlaps(b.value)) << a.value.toDecimal(50) << " " << b.value.toDecimal(50);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_TRUE(a.gradient(i).overlaps(b.gradient(i))) << i;
    for (Eigen::Index j = 0; j < 2; ++j) EXPECT_TRUE(a.hessian(i, j).overlaps(b.hessian(i, j))) << i << j;
  }
}

TEST(FlatlandIntegral, SegmentOverheadHasTheClosedForm) {
  // Between the angles -a and a, E = 2 sin a.
  const Segment segment{"overhead", {{{-0.75, 1}, {0.75, 1}}}, 1.0};
  const FlatlandEnclosure e = encloseFlatland(segment, {{0, 0}, {0, 1}}, 40);
  EXPECT_TRUE((e.value * Ball(1.25)).contains(Ball(1.5)));  // sin a = 0.75 / 1.25
  EXPECT_TRUE(e.gradient(0).containsZero());
  EXPECT_GE(correctDigits(e), 40);
}

TEST(FlatlandIntegral, AgreesWithDifferencesOfTheClosedForm) {
  for (const FlatlandReceiver& receiver :
       {FlatlandReceiver{{0.1, -0.2}, {0, 1}}, FlatlandReceiver{{0.1, 0.9}, {0.6, 0.8}}}) {
    const Segment segment{"slanted", {{{-0.7, 0.4}, {1.1, 1.3}}}, 1.0};
    const FlatlandEnclosure proven = encloseFlatland(segment, receiver, 45);
    const FlatlandEnclosure differences = differenceFlatland(segment, receiver);
    EXPECT_GE(correctDigits(differences), 45);
    expectOverlap(proven, differences);
    FlatlandEnclosure twin = differences;
    twin.hessian(1, 1) *= Ball(1) + Ball::fromDecimal("1e-44");
    EXPECT_FALSE(twin.hessian(1, 1).overlaps(proven.hessian(1, 1)));
  }
}

TEST(FlatlandIntegral, BothSidesShine) {
  const FlatlandReceiver receiver{{0.1, -0.2}, {0, 1}};
  expectOverlap(encloseFlatland({"a", {{{-0.7, 0.4}, {1.1, 1.3}}}, 1.0}, receiver, 40),
                encloseFlatland({"b", {{{1.1, 1.3}, {-0.7, 0.4}}}, 1.0}, receiver, 40));
}

TEST(FlatlandIntegral, RefusesWhereTheHessianDoesNotExist) {
  const FlatlandReceiver receiver{{0, 0}, {0, 1}};
  EXPECT_THROW(encloseFlatland({"end on horizon", {{{1, 0}, {1, 1}}}, 1.0}, receiver, 20), std::domain_error);
  EXPECT_THROW(encloseFlatland({"on its line", {{{0, 1}, {0, 2}}}, 1.0}, receiver, 20), std::domain_error);
}

}  // namespace
}  // namespace irradiff
