// Irradiance and rotational gradient as sums over strata, against exact scenes.

#include "derivatives/estimators/strata_sums.h"

#include "tests/estimators/convergence.h"
#include "tests/estimators/convergence_order.h"
#include "tests/estimators/sampled_scene.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnitRoundoff = 0x1p-53;

StrataSums sumsFor(const Strata& strata) { return {strata.stratification(), strata.shape()}; }

std::vector<Polygon> colouredRoom() {
  std::vector<Polygon> scene = room(1.0);
  for (std::size_t i = 0; i < scene.size(); ++i) scene[i].radiance = 0.3 + 0.4 * static_cast<double>(i);
  scene.push_back(parallelogram("table", {0.2, 0.1, 0.7}, {0.35, 0.1, 0.0}, {-0.1, 0.3, 0.1}, 0.2));
  return scene;
}

TEST(StrataSums, OfConstantRadiance) {
  for (const Stratification stratification : kAllStratifications) {
    for (const std::size_t n : {4U, 16U, 64U}) {
      const Strata strata = strataOfSize(stratification, n);
      const HemisphereSamples samples = uniformSamples(strata, 2.0, 3.0);
      // A rounding for each sample of a partial sum, and a few for weights.
      const double bound = (8.0 + static_cast<double>(samples.shape.size()) / 8.0) * kUnitRoundoff;
      EXPECT_NEAR(sumsFor(strata).irradiance(samples), 3.0 * kPi, bound * 3.0 * kPi);
      // Directions in the middle of strata lie opposite each other; the sum of what cancels is below 2 pi L.
      EXPECT_LE(sumsFor(strata).rotationalGradient(samples).norm(), bound * 6.0 * kPi);
    }
  }
}

struct Errors {
  double irradiance, rotational_gradient, turned_back;
};

/// Medians over receivers, relative; the last against the negative of the gradient.
Errors medianErrors(Stratification stratification, std::size_t n) {
  const std::vector<Polygon> scene = colouredRoom();
  const Strata strata = strataOfSize(stratification, n);
  const StrataSums sums = sumsFor(strata);
  std::vector<double> irradiance, rotational, turned_back;
  for (const Eigen::Vector3d& position : receivers(200, 0.8)) {
    const SceneDerivatives truth = trueDerivatives(scene, frameAt(position));
    const HemisphereSamples samples =
        sampleScene(scene, frameAt(position), strata, SamplePlaces::jittered(irradiance.size() + 1));
    const Eigen::Vector3d g = sums.rotationalGradient(samples);
    irradiance.push_back(std::abs(sums.irradiance(samples) - truth.irradiance) / truth.irradiance);
    rotational.push_back((g - truth.rotational_gradient).norm() / truth.rotational_gradient.norm());
    turned_back.push_back((g + truth.rotational_gradient).norm() / truth.rotational_gradient.norm());
  }
  return {median(irradiance), median(rotational), median(turned_back)};
}

TEST(StrataSums, ConvergeToTheScenes) {
  const std::vector<std::size_t> sizes{16, 32, 64};
  for (const Stratification stratification : kAllStratifications) {
    std::vector<double> irradiance, rotational;
    for (const std::size_t n : sizes) {
      const Errors errors = medianErrors(stratification, n);
      irradiance.push_back(errors.irradiance);
      rotational.push_back(errors.rotational_gradient);
      std::cout << "stratification " << static_cast<int>(stratification) << ", n = " << n << ": median error "
                << errors.irradiance << " (irradiance), " << errors.rotational_gradient << " (rotational gradient)\n";
      EXPECT_GT(errors.turned_back, 1.0) << "the rotational gradient of the other sign";
    }
    // A jittered sample in each stratum errs where edges pass through strata: order 3/2, less what is left to chance.
    EXPECT_GT(convergenceOrder(sizes, irradiance), 1.0);
    EXPECT_GT(convergenceOrder(sizes, rotational), 1.0);
  }
}

TEST(StrataSums, AreFiniteOnTheHorizon) {
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 8);
    HemisphereSamples samples = uniformSamples(strata, 1.0, 1.0);
    for (std::size_t i = 0; i < samples.shape.size(); ++i) {
      const double sine = std::hypot(samples.direction_t[i], samples.direction_b[i]);
      samples.direction_t[i] /= sine;
      samples.direction_b[i] /= sine;
      samples.direction_n[i] = 0.0;
      samples.radiance[i] = samples.direction_t[i] > 0.0 ? 1.0 : 0.0;
    }
    const Eigen::Vector3d g = sumsFor(strata).rotationalGradient(samples);
    EXPECT_TRUE(g.allFinite());
    // All radiance on the side of t: n turned about b from n towards t gains, and g is along b = n x t. At most pi.
    EXPECT_GT(g.y(), 1.0);
    EXPECT_LE(g.y(), kPi);
  }
}

}  // namespace
}  // namespace irradiff
