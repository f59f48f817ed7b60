#include "verification/certified/certified_polygon.h"

#include "derivatives/scene/invalid_scene.h"
#include "verification/checks/input_families.h"
#include "verification/enclosure/contour_enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

const Polygon kLamp{"lamp", {{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, 1}}, 1.0};
const Receiver kBelow{{0.3, 0, 0}, {0, 0, 1}};

TEST(CertifiedPolygon, EveryRungAgreesWithTheOthersWithinItsBounds) {
  for (const InputFamily& family : inputFamilies()) {
    for (const Configuration& c : drawInputs(family, 20, 5)) {
      const CertifiedPolygon balls = certifyPolygonAt(Rung::kBall, c.polygon, 0, c.receiver, 1e-25);
      for (const Rung rung : {Rung::kDouble, Rung::kExtended}) {
        const CertifiedPolygon other = certifyPolygonAt(rung, c.polygon, 0, c.receiver, 1e-25);
        const auto& a = balls.evaluation;
        const auto& b = other.evaluation;
        EXPECT_LE(std::abs(a.derivatives.irradiance.value - b.derivatives.irradiance.value),
                  a.bounds.irradiance + b.bounds.irradiance)
            << family.name << sceneLine(c);
        // A bound that knows nothing is infinite.
        if (!std::isfinite(b.bounds.hessian)) continue;
        EXPECT_LE((a.derivatives.hessian.value - b.derivatives.hessian.value).cwiseAbs().maxCoeff(),
                  a.bounds.hessian + b.bounds.hessian)
            << family.name << sceneLine(c);
      }
    }
  }
}

TEST(CertifiedPolygon, HoldsThirtyDigits) {
  const CertifiedPolygon certified = certifyPolygon(kLamp, 0, kBelow, 1e-30);
  ASSERT_TRUE(certified.enclosure);
  EXPECT_EQ(certified.rung, Rung::kBall);
  const FormFactorEnclosure reference = encloseContour(kLamp, kBelow, 60);
  const WorkingPrecision precision(512);
  // Seen from below the vertices of the lamp run counterclockwise.
  const Ball factor = reference.value > Ball(0) ? Ball::pi() : -Ball::pi();
  const Ball irradiance = reference.value * factor;
  const Ball& ours = certified.enclosure->irradiance.value;
  EXPECT_TRUE(ours.overlaps(irradiance));
  EXPECT_TRUE(ours.radius() <= irradiance * Ball(1e-30));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(certified.enclosure->gradient.value(i).overlaps(reference.gradient(i) * factor));
    for (int j = 0; j < 3; ++j) {
      EXPECT_TRUE(certified.enclosure->hessian.value(i, j).overlaps(reference.hessian(i, j) * factor));
    }
  }
  // The twin: the next lamp is another one.
  EXPECT_FALSE((ours * Ball(1.0 + 1e-15)).overlaps(irradiance));
}

TEST(CertifiedPolygon, StaysInDoubleForOrdinaryInput) {
  const CertifiedPolygon certified = certifyPolygon(kLamp, 0, kBelow, kDefaultTolerance);
  EXPECT_EQ(certified.rung, Rung::kDouble);
  EXPECT_FALSE(certified.enclosure);
  EXPECT_LE(certified.evaluation.bounds.hessian,
            kDefaultTolerance * certified.evaluation.derivatives.hessian.value.cwiseAbs().maxCoeff());
}

TEST(CertifiedPolygon, AtMostOneInAHundredGenericPolygonsClimbs) {
  std::size_t climbing = 0;
  const std::size_t count = lengthened(4000);
  for (const Configuration& c : drawInputs(inputFamily("generic"), count, 11)) {
    if (certifyPolygon(c.polygon, 0, c.receiver, kDefaultTolerance).rung != Rung::kDouble) ++climbing;
  }
  EXPECT_LE(climbing, count / 100);
  // The twin: a tolerance that double cannot meet.
  EXPECT_NE(certifyPolygon(kLamp, 0, kBelow, 1e-16).rung, Rung::kDouble);
}

TEST(CertifiedPolygon, SaysNothingIsSeenBelowTheHorizon) {
  const CertifiedPolygon certified = certifyPolygon(kLamp, 0, {{0, 0, 0}, {0, 0, -1}}, 1e-30);
  EXPECT_EQ(certified.evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_EQ(certified.evaluation.bounds.hessian, 0.0);
  EXPECT_EQ(certified.rung, Rung::kDouble);
}

TEST(CertifiedPolygon, RefusesWhatThePlainPathRefuses) {
  const Receiver at_vertex{{0.5, 0.5, 1}, {0, 0, -1}};
  EXPECT_THROW(certifyPolygon(kLamp, 3, at_vertex, 1e-12), InvalidScene);
  EXPECT_THROW(certifyPolygon(kLamp, 0, kBelow, 0.0), std::invalid_argument);
  EXPECT_THROW(certifyPolygon(kLamp, 0, kBelow, 2.0), std::invalid_argument);
}

}  // namespace
}  // namespace irradiff
