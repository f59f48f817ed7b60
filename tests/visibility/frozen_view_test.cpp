// What is seen, and the derivatives of irradiance, by ways that share neither predicates nor formulas.

#include "verification/occlusion/frozen_view.h"

#include "verification/checks/input_families.h"
#include "verification/occlusion/scene_families.h"
#include "verification/visible_region/region_differences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;

using Digits = Multiprecision;

/// 0 where both are.
template <class Values>
Digits relativeError(const Values& actual, const Values& expected) {
  Digits error = 0;
  Digits size = 0;
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    error = std::max<Digits>(error, abs(actual(i) - expected(i)));
    size = std::max<Digits>(size, abs(expected(i)));
  }
  return error == 0 ? Digits(0) : Digits(error / size);
}

Digits tenTo(int exponent) { return pow(Digits(10), exponent); }

/// 2^-150 of the scene.
Digits stepOf(const OccludedScene& scene) { return ldexp(Digits(extentOf(scene)), -150); }

TEST(CutScene, SquareOverhead) {
  // A unit square at distance 1 over its centre: the published form factor of a differential element to a rectangle.
  const std::vector<Polygon> square = {
      {"square", {{-0.5, -0.5, 1.0}, {0.5, -0.5, 1.0}, {0.5, 0.5, 1.0}, {-0.5, 0.5, 1.0}}, 1.0}};
  const MultiprecisionVector v =
      CutScene(square).vectorIrradiance(MultiprecisionVector::Constant(0), {Digits(0), Digits(0), Digits(1)});
  const Digits side = sqrt(Digits(5) / 4);
  const Digits expected = 4 * (Digits(1) / 2) / side * atan(Digits(1) / 2 / side);
  EXPECT_LT(Digits(abs(v(2) - expected)), tenTo(-190));
  EXPECT_LT(Digits(abs(v(0))), tenTo(-190));
}

TEST(CutScene, ScreenTakesAwayItsOwnFormFactor) {
  const auto square = [](double height, double half, double radiance) {
    return Polygon{"square",
                   {{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}},
                   radiance};
  };
  const MultiprecisionVector x{Digits(0.125), Digits(-0.25), Digits(0)};
  const MultiprecisionVector n{Digits(0), Digits(0), Digits(1)};
  const auto irradiance = [&](const std::vector<Polygon>& scene) { return CutScene(scene).vectorIrradiance(x, n)(2); };
  const Polygon lamp = square(2.0, 1.0, 3.0);
  const Digits lost = irradiance({lamp}) - irradiance({lamp, square(1.0, 0.25, 0.0)});
  EXPECT_LT(Digits(abs(lost - irradiance({square(1.0, 0.25, 3.0)}))), tenTo(-190));
  // Behind the lamp it takes nothing.
  EXPECT_LT(Digits(abs(irradiance({lamp}) - irradiance({lamp, square(3.0, 0.25, 0.0)}))), tenTo(-190));
}

TEST(RegionDifferences, DoNotDependOnTheStep) {
  for (const SceneFamily& family : sceneFamilies()) {
    const OccludedScene scene = drawScene(family, kSeed, 100);
    const CutScene regions(scene.polygons);
    const RegionValue value = differentiateRegions(regions, scene.receiver, stepOf(scene));
    const RegionValue other = differentiateRegions(regions, scene.receiver, stepOf(scene) * 1024);
    EXPECT_LT(relativeError(other.hessian, value.hessian), tenTo(-40)) << family.name;
    if (value.irradiance > 0) {
      EXPECT_GT(relativeError(other.hessian, value.hessian), tenTo(-100)) << family.name;
    }
  }
}

/// The topology is the true one at the receiver and at every place of the differences' stencil: with it frozen,
/// irradiance is what is left when all that is hidden is cut away.
TEST(FrozenView, IrradianceIsThatOfVisibleRegionsThroughoutTheStencil) {
  Digits worst = 0;
  for (const SceneFamily& family : sceneFamilies()) {
    for (std::size_t k = 0; k < lengthened(2); ++k) {
      const OccludedScene scene = drawScene(family, kSeed, k);
      const FrozenView frozen(scene);
      const CutScene regions(scene.polygons);
      const MultiprecisionVector n = withoutRounding(scene.receiver.normal);
      const MultiprecisionVector x = withoutRounding(scene.receiver.position);
      const Digits scale(std::numbers::pi * 10.0);
      for (int i = 0; i < 27; ++i) {
        const MultiprecisionVector offset{Digits(i % 3 - 1), Digits(i / 3 % 3 - 1), Digits(i / 9 - 1)};
        const MultiprecisionVector y = x + MultiprecisionVector(offset * stepOf(scene));
        const MultiprecisionVector v = regions.vectorIrradiance(y, n);
        const Digits expected = n(0) * v(0) + n(1) * v(1) + n(2) * v(2);
        worst = std::max<Digits>(worst, abs(frozen.irradiance(y) - expected) / scale);
        ASSERT_LT(worst, tenTo(-170)) << family.name << ' ' << sceneLine(scene);
      }
    }
  }
  std::cout << "frozen topology against visible regions, worst difference " << worst.convert_to<double>() << '\n';
}

/// Differences of E alone, Jets of E alone through the frozen topology, and the formulas: three ways to one gradient
/// and one Hessian. With the vertices' motion left out of the third they part.
TEST(FrozenView, JetsAndFormulasAreTheDifferencesOfIrradiance) {
  Digits worst_gradient = 0;
  Digits worst_hessian = 0;
  for (const SceneFamily& family : sceneFamilies()) {
    for (std::size_t k = 0; k < lengthened(4); ++k) {
      const OccludedScene scene = drawScene(family, kSeed + 1, k);
      const RegionValue expected = differentiateRegions(CutScene(scene.polygons), scene.receiver, stepOf(scene));
      const FrozenView frozen(scene);
      const FrozenView::Derivatives jets = frozen.differentiated();
      const IrradianceDerivatives<Digits> formulas = frozen.formulas();
      for (const MultiprecisionVector& gradient : {jets.gradient, formulas.gradient.value}) {
        worst_gradient = std::max(worst_gradient, relativeError(gradient, expected.gradient));
      }
      for (const MultiprecisionMatrix& hessian : {jets.hessian, formulas.hessian.value}) {
        worst_hessian = std::max(worst_hessian, relativeError(hessian, expected.hessian));
      }
      // The step is 7e-46 of the scene, events are hardly nearer than 1e-16.
      ASSERT_LT(worst_gradient, tenTo(-55)) << family.name << ' ' << sceneLine(scene);
      ASSERT_LT(worst_hessian, tenTo(-55)) << family.name << ' ' << sceneLine(scene);
      EXPECT_LT(relativeError(formulas.tangential_hessian.value, expected.tangential_hessian), tenTo(-50))
          << family.name << ' ' << sceneLine(scene);
      EXPECT_LT(relativeError(formulas.rotational_gradient.value, expected.rotational_gradient), tenTo(-150))
          << family.name << ' ' << sceneLine(scene);
    }
  }
  std::cout << "Jets and formulas against differences of regions, worst: gradient "
            << worst_gradient.convert_to<double>() << ", Hessian " << worst_hessian.convert_to<double>() << '\n';
}

}  // namespace
}  // namespace irradiff
