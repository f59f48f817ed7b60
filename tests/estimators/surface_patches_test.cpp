// Planes through hits, and the derivatives of the patches in them against differences of the form factor's integrand.

#include "derivatives/estimators/surface_patches.h"

#include "tests/estimators/sampled_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Everything above the horizon is the plane q.p = 1, or nothing where that is behind.
void putPlane(HemisphereSamples& samples, const Vector3d& q) {
  for (std::size_t i = 0; i < samples.shape.size(); ++i) {
    samples.inverse_distance[i] = std::max(0.0, q.dot(samples.direction(i)));
  }
}

const Vector3d kPlane(0.3, -0.2, 0.7);

TEST(SurfacePatches, PlaneThroughCoplanarHitsIsTheirs) {
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 16);
    HemisphereSamples samples = sampleScene({}, frameAt(Vector3d::Zero()), strata, SamplePlaces::jittered(3));
    putPlane(samples, kPlane);
    const std::vector<Vector3d> planes = SurfacePatches(strata).inversePlanes(samples);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (samples.inverse_distance[i] == 0.0) {
        EXPECT_EQ(planes[i], Vector3d::Zero());
      } else {
        // Jittered neighbours may be close to a great circle: the best of several triangles is not.
        EXPECT_LE((planes[i] - kPlane).norm(), 1e-10) << i;
      }
    }
  }
}

/// Two planes, one behind the other, and at the step between them no third: hits there may take the direction of the
/// other plane, if that is flatter, but no hit has a plane that joins near and far ones.
TEST(SurfacePatches, AStepInDepthKeepsBothPlanes) {
  const Strata strata(Stratification::kConcentric, {16, 16});
  const Vector3d near(0.2, 0.1, 1.0);
  const Vector3d far(0.1, 0.0, 0.5);
  HemisphereSamples samples = uniformSamples(strata, 1.0, 0.0);
  for (std::size_t i = 0; i < samples.shape.size(); ++i) {
    const Vector3d w = samples.direction(i);
    samples.inverse_distance[i] = (w.x() > 0.1 ? far : near).dot(w);
  }
  const std::vector<Vector3d> planes = SurfacePatches(strata).inversePlanes(samples);
  std::size_t turned = 0;
  for (std::size_t i = 0; i < samples.shape.size(); ++i) {
    const Vector3d w = samples.direction(i);
    const bool is_far = w.x() > 0.1;
    const Vector3d own = is_far ? far : near;
    const Vector3d other = is_far ? near : far;
    const Vector3d other_through_hit = samples.inverse_distance[i] / other.dot(w) * other;
    EXPECT_LE(std::min((planes[i] - own).norm(), (planes[i] - other_through_hit).norm()), 1e-12) << i;
    if ((planes[i] - own).norm() > 1e-12) ++turned;
  }
  // One of the two columns along the step.
  EXPECT_LE(turned, 16u);
}

TEST(SurfacePatches, AHitWithoutCompanyFacesTheReceiver) {
  for (const Strata& strata :
       {Strata(Stratification::kConcentric, {5, 5}), Strata(Stratification::kPolar, {1, 1}),
        Strata(Stratification::kConcentric, {1, 9}), Strata(Stratification::kHemicube, {6, 2})}) {
    HemisphereSamples samples = uniformSamples(strata, 1.0, 0.0);
    samples.inverse_distance.assign(samples.shape.size(), 0.0);
    const std::size_t alone = samples.shape.size() / 2;
    samples.inverse_distance[alone] = 0.4;
    const std::vector<Vector3d> planes = SurfacePatches(strata).inversePlanes(samples);
    EXPECT_EQ(planes[alone], 0.4 * samples.direction(alone));
  }
}

TEST(SurfacePatches, EqualDirectionsGiveNoNaN) {
  const Strata strata(Stratification::kConcentric, {2, 2});
  HemisphereSamples samples = uniformSamples(strata, 1.0, 1.0);
  // All four at the corner that they share.
  samples.direction_t.assign(4, 0.0);
  samples.direction_b.assign(4, 0.0);
  samples.direction_n.assign(4, 1.0);
  samples.inverse_distance = {1.0, 2.0, 3.0, 4.0};
  for (const Vector3d& plane : SurfacePatches(strata).inversePlanes(samples)) EXPECT_TRUE(plane.allFinite());
}

/// What a patch adds to the irradiance of a receiver at x, per unit of radiance: (n.p)(q.p)/|p|^4, scaled to the
/// stratum's projected solid angle at x = 0. Its height above the horizon changes as if its solid angle were the
/// stratum's.
std::function<double(const Vector3d&)> contribution(const Strata& strata, const HemisphereSamples& samples,
                                                    std::size_t stratum, const Vector3d& q) {
  const std::size_t columns = strata.shape().columns;
  const double projected = strata.projectedSolidAngle(stratum / columns, stratum % columns);
  const double solid_angle = strata.solidAngle(stratum / columns, stratum % columns);
  const Vector3d hit = samples.direction(stratum) / samples.inverse_distance[stratum];
  const double height_share = solid_angle * samples.direction_n[stratum] / projected;
  return [=](const Vector3d& x) {
    const Vector3d p = hit - x;
    const double height = 1.0 - height_share * x.z() / hit.z();
    const double facing = q.dot(p) / q.dot(hit);
    return projected * height * facing * std::pow(hit.squaredNorm() / p.squaredNorm(), 2);
  };
}

/// The largest difference between derivatives and central differences, in units of what the differences are good for.
double disagreement(const std::function<double(const Vector3d&)>& f, const PatchDerivatives& derivatives) {
  constexpr double kStep = 1e-3;
  const auto unit = [&](int i) { return Vector3d(kStep * Vector3d::Unit(i)); };
  Vector3d gradient;
  Matrix3d hessian;
  for (int i = 0; i < 3; ++i) {
    gradient(i) = (f(unit(i)) - f(-unit(i))) / (2.0 * kStep);
    for (int j = 0; j < 3; ++j) {
      hessian(i, j) = (f(unit(i) + unit(j)) - f(unit(i) - unit(j)) - f(unit(j) - unit(i)) + f(-unit(i) - unit(j))) /
                      (4.0 * kStep * kStep);
    }
  }
  // Second order in a step of a thousandth of the distance, times fourth derivatives: below 100 times the second.
  const double allowed = 1e-4;
  return std::max((gradient - derivatives.gradient).norm() / gradient.norm(),
                  (hessian - derivatives.hessian).norm() / hessian.norm()) /
         allowed;
}

TEST(SurfacePatches, DerivativesAgreeWithDifferences) {
  double worst = 0.0;
  for (const Stratification stratification : kAllStratifications) {
    const Strata strata = strataOfSize(stratification, 8);
    HemisphereSamples samples = uniformSamples(strata, 1.0, 1.0);
    putPlane(samples, kPlane);
    const SurfacePatches patches(strata);
    for (std::size_t i = 0; i < samples.shape.size(); ++i) {
      if (samples.inverse_distance[i] < 0.2) continue;
      const auto f = contribution(strata, samples, i, kPlane);
      const PatchDerivatives right = patches.derivatives(samples, i, kPlane);
      worst = std::max(worst, disagreement(f, right));
      EXPECT_EQ(right.hessian, right.hessian.transpose());

      // A patch that faces the receiver, whatever the surface; derivatives of the patch's position in place of the
      // receiver's; a small factor.
      const PatchDerivatives facing =
          patches.derivatives(samples, i, samples.inverse_distance[i] * samples.direction(i));
      EXPECT_GT(disagreement(f, facing), 1.0);
      EXPECT_GT(disagreement(f, {-right.gradient, right.hessian}), 1.0);
      EXPECT_GT(disagreement(f, {right.gradient, -right.hessian}), 1.0);
      EXPECT_GT(disagreement(f, {right.gradient, 1.01 * right.hessian}), 1.0);
    }
  }
  std::cout << "largest difference from central differences, in units of their error: " << worst << '\n';
  EXPECT_LE(worst, 1.0);
}

}  // namespace
}  // namespace irradiff
