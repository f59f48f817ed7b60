// The occlusion-unaware Hessian: right where nothing is hidden, and elsewhere the Hessian of what is seen, left in
// place.

#include "derivatives/estimators/radiometric.h"

#include "derivatives/estimators/surface_patches.h"
#include "tests/estimators/convergence.h"
#include "tests/estimators/sampled_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(Radiometric, ConvergesWhereNothingIsHidden) {
  for (const Stratification stratification : kAllStratifications) {
    for (const std::vector<Polygon>& scene : {tiltedEmitter(), levelEmitter()}) {
      const Convergence gradient = convergence("radiometric", stratification, scene, gradientError);
      EXPECT_TRUE(gradient.isReached()) << gradient;
      const Convergence hessian = convergence("radiometric", stratification, scene, hessianError);
      EXPECT_TRUE(hessian.isReached()) << hessian;
      const Convergence tangential = convergence("radiometric", stratification, scene, tangentialHessianError);
      EXPECT_TRUE(tangential.isReached()) << tangential;
      std::cout << "gradient " << gradient << "Hessian " << hessian << "tangential Hessian " << tangential;
    }
  }
}

/// Patches perpendicular to their rays, as one would have them without a normal: not even a level emitter converges.
TEST(Radiometric, FacingPatchesDoNotConverge) {
  const auto facing = [](const HemisphereSamples& samples) {
    const SurfacePatches patches({samples.stratification, samples.shape});
    IrradianceEstimate estimate;
    estimate.hessian = Matrix3d::Zero();
    for (std::size_t i = 0; i < samples.shape.size(); ++i) {
      const Vector3d plane = samples.inverse_distance[i] * samples.direction(i);
      *estimate.hessian += samples.radiance[i] * patches.derivatives(samples, i, plane).hessian;
    }
    return estimate;
  };
  const Convergence hessian = convergence(facing, Stratification::kConcentric, levelEmitter(), hessianError);
  EXPECT_FALSE(hessian.isReached()) << hessian;
}

/// The irradiance at x of what is seen from `frame`: other parts do not come into view and these do not leave it. By
/// midpoints over the area of each polygon, and derivatives by central differences.
SceneDerivatives withoutChangesOfOcclusion(const std::vector<Polygon>& scene, const SampleFrame& frame) {
  constexpr int kPoints = 250;
  constexpr double kStep = 1e-2;
  SceneDerivatives sum{0.0, Vector3d::Zero(), Vector3d::Zero(), Matrix3d::Zero()};
  for (const Polygon& polygon : scene) {
    if (polygon.radiance == 0.0) continue;
    const Vector3d u = polygon.vertices[1] - polygon.vertices[0];
    const Vector3d v = polygon.vertices[3] - polygon.vertices[0];
    const Vector3d area = u.cross(v) / (kPoints * kPoints);
    for (int i = 0; i < kPoints; ++i) {
      for (int j = 0; j < kPoints; ++j) {
        const Vector3d point = polygon.vertices[0] + (i + 0.5) / kPoints * u + (j + 0.5) / kPoints * v;
        const Vector3d to_point = point - frame.position;
        const Sight sight = look(scene, frame.position, to_point.normalized());
        if (sight.inverse_distance * to_point.norm() > 1.0 + 1e-9) continue;
        const auto f = [&](const Vector3d& x) {
          const Vector3d p = to_point - x;
          return polygon.radiance * p.z() * std::abs(area.dot(p)) / std::pow(p.squaredNorm(), 2);
        };
        const double here = f(Vector3d::Zero());
        for (int a = 0; a < 3; ++a) {
          const Vector3d e = kStep * Vector3d::Unit(a);
          sum.gradient(a) += (f(e) - f(-e)) / (2.0 * kStep);
          sum.hessian(a, a) += (f(e) - 2.0 * here + f(-e)) / (kStep * kStep);
          for (int b = 0; b < a; ++b) {
            const Vector3d d = kStep * Vector3d::Unit(b);
            const double mixed = (f(e + d) - f(e - d) - f(d - e) + f(-e - d)) / (4.0 * kStep * kStep);
            sum.hessian(a, b) += mixed;
            sum.hessian(b, a) += mixed;
          }
        }
      }
    }
  }
  return sum;
}

TEST(Radiometric, UnderOccludersConvergesToWhatIsSeenLeftInPlace) {
  const Convergence hessian = convergence("radiometric", Stratification::kConcentric, occludedEmitter(), hessianError,
                                          withoutChangesOfOcclusion);
  EXPECT_TRUE(hessian.isReached()) << hessian;
  const Convergence to_truth = convergence("radiometric", Stratification::kConcentric, occludedEmitter(), hessianError);
  EXPECT_FALSE(to_truth.isReached()) << to_truth;
  EXPECT_GT(to_truth.errors.back(), 0.5);
  std::cout << "without changes of occlusion, " << hessian << "against the scene's Hessian, " << to_truth;
}

}  // namespace
}  // namespace irradiff
