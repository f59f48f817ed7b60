#include "verification/certified/certified_scene.h"

#include "derivatives/scene/invalid_scene.h"
#include "verification/checks/input_families.h"
#include "verification/exact_boundary/exact_boundary.h"
#include "verification/occlusion/scene_families.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace irradiff {
namespace {

/// Visibility in rational numbers and the boundary formulas in balls of 512 bits.
struct ExactScene {
  IrradianceDerivatives<Ball> derivatives;
  bool has_gradient;
  bool has_hessian;
};

ExactScene exactly(const OccludedScene& scene) {
  const WorkingPrecision precision(512);
  std::vector<double> radiances;
  for (const Polygon& polygon : scene.polygons) radiances.push_back(polygon.radiance);
  const ExactBoundary boundary =
      exactBoundary(exactVisibility(scene.polygons, scene.receiver), scene.polygons, radiances, scene.receiver);
  return {sumsOf<Ball>(boundary, irradiff::exactly(scene.receiver.normal)).derivatives, boundary.no_gradient.empty(),
          boundary.no_hessian.empty()};
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
bool holds(const CertifiedScene<3>& certified, const ExactScene& exact, double shrink) {
  const SceneEvaluation<3>& evaluation = certified.evaluation;
  const IrradianceDerivatives<double>& d = evaluation.derivatives;
  const IrradianceDerivatives<Ball>& e = exact.derivatives;
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

TEST(CertifiedScene, BoundsHoldAgainstExactVisibilityInEveryFamily) {
  std::size_t compared = 0;
  std::size_t climbed = 0;
  std::size_t refuted_twins = 0;
  for (const SceneFamily& family : sceneFamilies()) {
    for (std::size_t i = 0; i < lengthened(12); ++i) {
      const OccludedScene scene = drawScene(family, 17, i);
      CertifiedScene<3> certified;
      ExactScene exact{{}, false, false};
      try {
        certified = certifyScene(SceneEvaluator(scene.polygons), scene.receiver, kDefaultTolerance);
        exact = exactly(scene);
      } catch (const InvalidScene&) {
        continue;  // not planar to the last bit, or a receiver on a polygon
      }
      ++compared;
      EXPECT_TRUE(holds(certified, exact, 1.0)) << family.name << " " << i;
      EXPECT_FALSE(certified.misses_tolerance) << family.name << " " << i;
      if (certified.rung() != Rung::kDouble) ++climbed;
      if (!holds(certified, exact, 1e-4)) ++refuted_twins;
    }
  }
  EXPECT_GT(compared, 50U);
  EXPECT_GT(refuted_twins, compared / 4);
  std::cout << compared << " scenes compared, " << climbed << " climbed above double\n";
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
    const ExactScene exact = exactly({{kLamp, kScreen}, kReceiver});
    if (!scene.enclosure) continue;
    const WorkingPrecision precision(512);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Ball& ours = scene.enclosure->hessian.value(i, j);
        EXPECT_TRUE(ours.overlaps(exact.derivatives.hessian.value(i, j)));
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

TEST(CertifiedScene, ADarkSceneIsExact) {
  const SceneEvaluator evaluator(std::vector<Polygon>{kScreen});
  const CertifiedScene<3> scene = certifyScene(evaluator, kReceiver, 1e-30);
  EXPECT_EQ(scene.evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_EQ(scene.evaluation.bounds.hessian, 0.0);
  EXPECT_EQ(scene.rung(), Rung::kDouble);
}

}  // namespace
}  // namespace irradiff
