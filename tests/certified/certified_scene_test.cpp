#include "verification/certified/certified_scene.h"

#include "derivatives/scene/invalid_scene.h"
#include "tests/exact_visibility/random_scene.h"
#include "tests/visibility/degenerate_scenes.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/enclosure/ball_vector.h"
#include "verification/exact_boundary/exact_boundary.h"
#include "verification/occlusion/occluded_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

/// Visibility in rational numbers and the boundary formulas in balls of 512 bits.
IrradianceDerivatives<Ball> exactDerivatives(const OccludedScene& scene) {
  const WorkingPrecision precision(512);
  std::vector<double> radiances;
  for (const Polygon& polygon : scene.polygons) radiances.push_back(polygon.radiance);
  const ExactBoundary boundary =
      exactBoundary(exactVisibility(scene.polygons, scene.receiver), scene.polygons, radiances, scene.receiver);
  return sumsOf<Ball>(boundary, exactly(scene.receiver.normal)).derivatives;
}

bool areWithin(const Eigen::MatrixXd& values, double bound,
               const std::function<Ball(Eigen::Index, Eigen::Index)>& reference) {
  const WorkingPrecision precision(512);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      if (abs(Ball(values(i, j)) - reference(i, j)) > Ball(bound)) return false;
    }
  }
  return true;
}

/// Whether everything that exists is within `shrink` times its bound.
bool holds(const CertifiedScene<3>& certified, const IrradianceDerivatives<Ball>& e, double shrink) {
  const SceneEvaluation<3>& evaluation = certified.evaluation;
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  const auto& bounds = evaluation.bounds;
  bool all = areWithin(Eigen::MatrixXd::Constant(1, 1, d.irradiance.value), shrink * bounds.irradiance,
                       [&](auto, auto) { return e.irradiance.value; });
  all = all && areWithin(d.rotational_gradient.value, shrink * bounds.rotational_gradient,
                         [&](auto i, auto) { return e.rotational_gradient.value(i); });
  if (evaluation.no_gradient.empty()) {
    all =
        all && areWithin(d.gradient.value, shrink * bounds.gradient, [&](auto i, auto) { return e.gradient.value(i); });
  }
  if (evaluation.no_hessian.empty()) {
    all = all &&
          areWithin(d.hessian.value, shrink * bounds.hessian, [&](auto i, auto j) { return e.hessian.value(i, j); });
  }
  if (evaluation.no_tangential_hessian.empty()) {
    all = all && areWithin(d.tangential_hessian.value, shrink * bounds.tangential_hessian,
                           [&](auto i, auto j) { return e.tangential_hessian.value(i, j); });
  }
  return all;
}

struct Tally {
  std::size_t compared = 0;
  std::size_t partly_hidden = 0;
  std::size_t moving_vertices = 0;
  std::size_t climbed = 0;
  std::size_t missing_hessians = 0;
  std::size_t refuted_twins = 0;  ///< ten thousand times smaller bounds that are seen to be wrong
};

void compare(const OccludedScene& scene, Tally& tally) {
  CertifiedScene<3> certified;
  IrradianceDerivatives<Ball> exact;
  try {
    certified = certifyScene(SceneEvaluator(scene.polygons), scene.receiver, kDefaultTolerance);
    exact = exactDerivatives(scene);
  } catch (const InvalidScene&) {
    return;  // a receiver on a polygon, or one beside it in the same plane
  }
  ++tally.compared;
  EXPECT_TRUE(holds(certified, exact, 1.0)) << sceneLine(scene);
  EXPECT_FALSE(certified.misses_tolerance) << sceneLine(scene);
  if (certified.evaluation.has_occlusion) ++tally.partly_hidden;
  if (certified.evaluation.apparent_vertices > 0) ++tally.moving_vertices;
  if (certified.rung() != Rung::kDouble) ++tally.climbed;
  if (!certified.evaluation.no_hessian.empty()) ++tally.missing_hessians;
  if (!holds(certified, exact, 1e-4)) ++tally.refuted_twins;
}

TEST(CertifiedScene, BoundsHoldAgainstExactVisibility) {
  Tally tally;
  for (std::size_t i = 0; i < lengthened(200); ++i) {
    const RandomScene random = randomScene(17, i, 1 + i % 8);
    compare({random.polygons, random.receiver}, tally);
    const RandomScene lattice = latticeScene(17, i, 2 + i % 5);
    compare({lattice.polygons, lattice.receiver}, tally);
  }
  for (const SceneFamily& family : degenerateSceneFamilies()) {
    for (std::size_t i = 0; i < lengthened(20); ++i) {
      KeyedRandom random(17, family.name, i);
      const SceneWithReceivers scene = family.draw(random);
      for (const Receiver& receiver : scene.receivers) compare({scene.polygons, receiver}, tally);
    }
  }
  std::cout << tally.compared << " scenes compared, " << tally.partly_hidden << " partly hidden, "
            << tally.moving_vertices << " with apparent vertices, " << tally.missing_hessians << " without a Hessian, "
            << tally.climbed << " above double, " << tally.refuted_twins << " twins refuted\n";
  EXPECT_GT(tally.compared, lengthened(300));
  EXPECT_GT(tally.partly_hidden, tally.compared / 4);
  EXPECT_GT(tally.moving_vertices, tally.compared / 8);
  EXPECT_GT(tally.refuted_twins, tally.compared / 8);
}

TEST(CertifiedScene, JumpsBetweenRadiancesAreExactInBothPaths) {
  // The difference of the radiances is no double.
  const OccludedScene scene{
      {{"near", {{2, 2, -1}, {-1, 1, 3}, {0, 0, 1}}, 0.5828157548659407},
       {"far", {{-1, -1, -2}, {3, 1, -1}, {-2, 1, 0}}, 9.052638053892366}},
      {{3, 1.4213894961120426, 4}, {0.4270941943286115, 0.7229026007517033, -0.5431412145999994}}};
  const CertifiedScene<3> certified = certifyScene(SceneEvaluator(scene.polygons), scene.receiver, 1e-30);
  ASSERT_TRUE(certified.evaluation.has_occlusion);
  const IrradianceDerivatives<Ball> exact = exactDerivatives(scene);
  EXPECT_TRUE(certified.enclosure->irradiance.value.overlaps(exact.irradiance.value));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(certified.enclosure->gradient.value(i).overlaps(exact.gradient.value(i))) << i;
    for (int j = 0; j < 3; ++j) {
      EXPECT_TRUE(certified.enclosure->hessian.value(i, j).overlaps(exact.hessian.value(i, j))) << i << j;
    }
  }
}

const Polygon kLamp{"lamp", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}}, 2.0};
const Polygon kScreen{"screen", {{0.25, -2, 1}, {2, -2, 1.5}, {2, 0.5, 1.5}, {0.25, 0.5, 1}}, 0.0};
const Receiver kReceiver{{0.1, 0.2, 0}, {0, 0, 1}};

TEST(CertifiedScene, MeetsToleranceBeyondDouble) {
  const SceneEvaluator evaluator(std::vector<Polygon>{kLamp, kScreen});
  for (const double tolerance : {1e-12, 1e-20, 1e-30, 1e-50}) {
    const CertifiedScene<3> scene = certifyScene(evaluator, kReceiver, tolerance);
    EXPECT_FALSE(scene.misses_tolerance);
    EXPECT_EQ(scene.evaluation.apparent_vertices, 2U);
    EXPECT_TRUE(scene.evaluation.has_occlusion);
    const IrradianceDerivatives<Ball> exact = exactDerivatives({{kLamp, kScreen}, kReceiver});
    if (!scene.enclosure) continue;
    const WorkingPrecision precision(512);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Ball& ours = scene.enclosure->hessian.value(i, j);
        EXPECT_TRUE(ours.overlaps(exact.hessian.value(i, j)));
        EXPECT_TRUE(ours.radius() < Ball(10.0 * tolerance));
      }
    }
  }
}

TEST(CertifiedScene, SaysWhatDoesNotExist) {
  // The vertex of the screen over the edge of the lamp.
  const Polygon screen{"screen", {{0.5, 0.1, 1}, {2, -0.7, 1}, {2, 1.9, 1}}, 0.0};
  const SceneEvaluator evaluator(std::vector<Polygon>{kLamp, screen});
  const Receiver receiver{{0, 0, 0}, {0, 0, 1}};
  const CertifiedScene<3> scene = certifyScene(evaluator, receiver, 1e-30);
  EXPECT_FALSE(scene.evaluation.no_hessian.empty());
  EXPECT_TRUE(scene.evaluation.no_gradient.empty());
  EXPECT_FALSE(scene.misses_tolerance);
  EXPECT_EQ(scene.evaluation.derivatives.hessian.value.norm(), 0.0);
}

TEST(CertifiedScene, AKinkThatNoPrecisionTellsIsSaidToBeOne) {
  // A saddle, flat to the validator, of which as much is seen from one side as from the other: E is 0 and |F| has a
  // kink.
  constexpr double kRise = 0x1p-52;
  const Polygon saddle{"saddle", {{1, 1, kRise}, {1, -1, -kRise}, {-1, -1, kRise}, {-1, 1, -kRise}}, 1.0};
  const SceneEvaluator evaluator(std::vector<Polygon>{saddle});
  const CertifiedScene<3> scene = certifyScene(evaluator, {{3, 0, 0}, {-1, 0, 0}}, kDefaultTolerance);
  EXPECT_LT(scene.evaluation.derivatives.irradiance.value + scene.evaluation.bounds.irradiance, 1e-300);
  EXPECT_NE(scene.evaluation.no_gradient.find("kink"), std::string::npos);
  EXPECT_NE(scene.evaluation.no_hessian.find("kink"), std::string::npos);
  EXPECT_TRUE(scene.misses_tolerance);
}

TEST(CertifiedScene, HoldsWhereDoubleRefusesNearAndFarTogether) {
  const auto square = [](const char* name, double unit, double shift, double radiance) {
    return Polygon{name,
                   {{unit * (shift - 1), -unit, unit},
                    {unit * (shift + 1), -unit, unit},
                    {unit * (shift + 1), unit, unit},
                    {unit * (shift - 1), unit, unit}},
                   radiance};
  };
  const OccludedScene scene{{square("lamp", 0x1p170, 0.0, 1.0), square("speck", 0x1p-130, 0.75, 0.0)},
                            {{0, 0, 0}, {0, 0, 1}}};
  const SceneEvaluator evaluator(scene.polygons);
  EXPECT_THROW(evaluator.evaluate(scene.receiver), InvalidScene);
  const CertifiedScene<3> certified = certifyScene(evaluator, scene.receiver, kDefaultTolerance);
  const IrradianceDerivatives<Ball> exact = exactDerivatives(scene);
  EXPECT_TRUE(holds(certified, exact, 1.0));
  EXPECT_FALSE(certified.misses_tolerance);
  // The twin: the lamp alone.
  EXPECT_FALSE(
      holds(certifyScene(SceneEvaluator(std::vector<Polygon>{scene.polygons[0]}), scene.receiver, 1e-12), exact, 1.0));
}

TEST(CertifiedScene, ADarkSceneIsExact) {
  const SceneEvaluator evaluator(std::vector<Polygon>{kScreen});
  const CertifiedScene<3> scene = certifyScene(evaluator, kReceiver, 1e-30);
  EXPECT_EQ(scene.evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_EQ(scene.evaluation.bounds.hessian, 0.0);
  EXPECT_EQ(scene.rung(), Rung::kDouble);
}

}  // namespace
}  // namespace irradiff
