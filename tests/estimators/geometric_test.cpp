// The geometric Hessian from the radiometric ones of single strata.

#include "derivatives/estimators/geometric.h"

#include "derivatives/estimators/radiometric.h"
#include "tests/estimators/convergence.h"
#include "tests/estimators/sampled_scene.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector3d;

HemisphereSamples roomSamples(const Strata& strata) {
  HemisphereSamples samples = sampleScene(room(1.0), frameAt({0.4, -0.2, 0.0}), strata, SamplePlaces::jittered(5));
  for (std::size_t i = 0; i < samples.shape.size(); ++i) samples.radiance[i] = static_cast<double>(i % 5);
  return samples;
}

/// The radiometric Hessian of each stratum alone, at radiance 1.
std::vector<Matrix2d> singleHessians(HemisphereSamples samples) {
  const auto estimator = makeRadiometric(samples.stratification, samples.shape);
  std::vector<Matrix2d> hessians;
  for (std::size_t i = 0; i < samples.shape.size(); ++i) {
    std::fill(samples.radiance.begin(), samples.radiance.end(), 0.0);
    samples.radiance[i] = 1.0;
    hessians.push_back(*estimator->estimate(samples).tangential_hessian);
  }
  return hessians;
}

Matrix2d absoluteByEigenvectors(const Matrix2d& m) {
  const Eigen::SelfAdjointEigenSolver<Matrix2d> solver(m);
  return solver.eigenvectors() * solver.eigenvalues().cwiseAbs().asDiagonal() * solver.eigenvectors().transpose();
}

TEST(Geometric, IsTheSumOfAbsoluteCurvaturesTimesTheMeanRadiance) {
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 8);
    const HemisphereSamples samples = roomSamples(strata);
    const IrradianceEstimate estimate = makeGeometric(stratification, samples.shape)->estimate(samples);
    Matrix2d expected = Matrix2d::Zero();
    Matrix2d without_absolute = Matrix2d::Zero();
    for (const Matrix2d& hessian : singleHessians(samples)) {
      expected += estimate.irradiance / std::numbers::pi * absoluteByEigenvectors(hessian);
      without_absolute += estimate.irradiance / std::numbers::pi * hessian;
    }
    const double bound = 1e-12 * expected.norm();
    EXPECT_LE((*estimate.tangential_hessian - expected).norm(), bound);
    EXPECT_GT((*estimate.tangential_hessian - without_absolute).norm(), 0.1 * expected.norm());
    EXPECT_FALSE(estimate.gradient.has_value());
    EXPECT_FALSE(estimate.hessian.has_value());
  }
}

/// The curvature of a hit at 1e-100 m is 1e200 in the unit of others; its square is no double.
TEST(Geometric, HasValuesWhereDeterminantsHaveNone) {
  const Strata strata(Stratification::kConcentric, {8, 8});
  HemisphereSamples samples = roomSamples(strata);
  samples.inverse_distance[20] = 1e100;
  const Matrix2d curvature =
      *makeGeometric(samples.stratification, samples.shape)->estimate(samples).tangential_hessian;
  EXPECT_TRUE(curvature.allFinite());
  EXPECT_GT(curvature.norm(), 1e195);
}

/// A dark floor beside a bright wall is as curved as beside a dark one, if only the mean is the same.
TEST(Geometric, IgnoresWhereRadianceComesFrom) {
  const Strata strata(Stratification::kConcentric, {16, 16});
  HemisphereSamples samples = roomSamples(strata);
  const auto estimator = makeGeometric(samples.stratification, samples.shape);
  const Matrix2d before = *estimator->estimate(samples).tangential_hessian;
  std::reverse(samples.radiance.begin(), samples.radiance.end());
  EXPECT_LE((*estimator->estimate(samples).tangential_hessian - before).norm(), 1e-13 * before.norm());
  const auto radiometric = makeRadiometric(samples.stratification, samples.shape);
  const Matrix2d reversed = *radiometric->estimate(samples).tangential_hessian;
  EXPECT_GT((reversed - *radiometric->estimate(roomSamples(strata)).tangential_hessian).norm(), 0.1 * reversed.norm());
}

TEST(Geometric, BoundsTheRadiometricHessianOfEveryRadianceUpToTheMean) {
  const Strata strata(Stratification::kConcentric, {16, 16});
  const HemisphereSamples samples = roomSamples(strata);
  const IrradianceEstimate geometric = makeGeometric(samples.stratification, samples.shape)->estimate(samples);
  const double mean = geometric.irradiance / std::numbers::pi;
  for (const std::size_t period : {2u, 3u, 7u}) {
    HemisphereSamples other = samples;
    for (std::size_t i = 0; i < samples.shape.size(); ++i) other.radiance[i] = i / 5 % period == 0 ? mean : 0.0;
    const Matrix2d hessian =
        *makeRadiometric(samples.stratification, samples.shape)->estimate(other).tangential_hessian;
    for (const double sign : {-1.0, 1.0}) {
      const Matrix2d slack = *geometric.tangential_hessian - sign * hessian;
      EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix2d>(slack).eigenvalues().minCoeff(), 0.0);
    }
  }
}

}  // namespace
}  // namespace irradiff
