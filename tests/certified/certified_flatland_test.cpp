#include "verification/certified/certified_flatland.h"

#include "derivatives/flatland/flatland_scene.h"
#include "derivatives/scene/invalid_scene.h"
#include "tests/flatland/scene_draws.h"
#include "verification/checks/flatland_inputs.h"
#include "verification/checks/input_families.h"
#include "verification/enclosure/flatland_integral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace irradiff {
namespace {

/// Whether the number is off by more than the bound, for certain.
bool isRefuted(double number, double bound, const Ball& reference) {
  return abs(Ball(number) - reference) > Ball(bound);
}

bool isRefuted(const CertifiedScene<2>& scene, double shrink, const FlatlandEnclosure& reference,
               const FlatlandReceiver& receiver) {
  const SceneEvaluation<2>& evaluation = scene.evaluation;
  const IrradianceDerivatives<double, 2>& d = evaluation.derivatives;
  const DerivativeBounds& bounds = evaluation.bounds;
  bool any = isRefuted(d.irradiance.value, shrink * bounds.irradiance, reference.value);
  // dE/dalpha for n turning counterclockwise.
  const Ball turn =
      Ball(receiver.normal(0)) * reference.normal_gradient(1) - Ball(receiver.normal(1)) * reference.normal_gradient(0);
  any = any || isRefuted(d.rotational_gradient.value(0), shrink * bounds.rotational_gradient, turn);
  for (int i = 0; i < 2; ++i) {
    any = any || isRefuted(d.gradient.value(i), shrink * bounds.gradient, reference.gradient(i));
    for (int j = 0; j < 2 && evaluation.no_hessian.empty(); ++j) {
      any = any || isRefuted(d.hessian.value(i, j), shrink * bounds.hessian, reference.hessian(i, j));
    }
  }
  return any;
}

TEST(CertifiedFlatland, BoundsHoldAgainstTheDefiningIntegralAndMeetTheTolerance) {
  const WorkingPrecision precision(256);
  std::size_t compared = 0;
  std::size_t refuted_twins = 0;
  for (const FlatlandFamily& family : flatlandFamilies()) {
    for (std::size_t i = 0; i < lengthened(8); ++i) {
      KeyedRandom random(5, family.name, i);
      const FlatlandConfiguration c = family.draw(random);
      try {
        const CertifiedScene<2> scene = certifyScene(std::vector{c.segment}, c.receiver, kDefaultTolerance);
        const FlatlandEnclosure reference = encloseFlatland(c.segment, c.receiver, 25);
        ++compared;
        EXPECT_FALSE(isRefuted(scene, 1.0, reference, c.receiver)) << family.name << sceneLine(c);
        EXPECT_FALSE(scene.misses_tolerance) << family.name << sceneLine(c);
        if (isRefuted(scene, 1e-4, reference, c.receiver)) ++refuted_twins;
      } catch (const std::domain_error&) {
        // An end on the horizon, or a receiver on the segment's line: the reference has no derivatives.
      } catch (const InvalidScene&) {
        // On the segment, or beyond the range of double.
      }
    }
  }
  EXPECT_GT(compared, 4 * flatlandFamilies().size());
  EXPECT_GT(refuted_twins, compared / 2);
}

TEST(CertifiedFlatland, AgreesWithThePlainPathWithinTheBoundsOfBoth) {
  std::size_t compared = 0;
  std::vector<SceneFamily> families(smoothFamilies().begin(), smoothFamilies().end());
  families.insert(families.end(), harshFamilies().begin(), harshFamilies().end());
  families.push_back({"grid", drawGrid});
  for (const SceneFamily& family : families) {
    for (std::size_t i = 0; i < lengthened(40); ++i) {
      KeyedRandom random(5, family.name, i);
      const FlatlandScene drawn = family.draw(random);
      SceneEvaluation<2> plain;
      CertifiedScene<2> certified;
      try {
        plain = evaluateScene(drawn.segments, drawn.receiver);
        certified = certifyScene(drawn.segments, drawn.receiver, 1e-20);
      } catch (const InvalidScene&) {
        continue;
      }
      ++compared;
      const SceneEvaluation<2>& c = certified.evaluation;
      EXPECT_EQ(c.no_gradient, plain.no_gradient);
      EXPECT_EQ(c.no_hessian, plain.no_hessian);
      EXPECT_EQ(c.crosses_horizon, plain.crosses_horizon);
      EXPECT_FALSE(certified.misses_tolerance) << sceneLine(drawn);
      EXPECT_LE(std::abs(c.derivatives.irradiance.value - plain.derivatives.irradiance.value),
                c.bounds.irradiance + plain.bounds.irradiance);
      if (!c.no_gradient.empty()) continue;
      EXPECT_LE((c.derivatives.gradient.value - plain.derivatives.gradient.value).cwiseAbs().maxCoeff(),
                c.bounds.gradient + plain.bounds.gradient);
      if (!c.no_hessian.empty()) continue;
      EXPECT_LE((c.derivatives.hessian.value - plain.derivatives.hessian.value).cwiseAbs().maxCoeff(),
                c.bounds.hessian + plain.bounds.hessian);
    }
  }
  EXPECT_GT(compared, 50U);
}

}  // namespace
}  // namespace irradiff
