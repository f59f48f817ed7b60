// The polyline over flatland samples against the scene that it is.

#include "derivatives/flatland/sample_polyline.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "tests/flatland/sampled_flatland.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

const FlatlandReceiver kOrigin{Vector2d(0.0, 0.0), Vector2d(0.0, 1.0)};

enum class Radiance { kOfFartherEnd, kOfNearerEnd };
enum class Ends { kOpen, kContinuedBelow };

FlatlandSamples randomSamples(std::size_t count) {
  KeyedRandom random(7, "polyline", count);
  return sampleJittered({FlatlandStratification::kCosine, count}, 3, [&random](const Vector2d&) {
    return FlatlandHit{1.0 / random.between(0.5, 3.0), random.between(0.0, 2.0)};
  });
}

/// The polyline as a scene, about a receiver at the origin whose normal points up.
std::vector<Segment> polylineScene(const FlatlandSamples& samples, Radiance rule, Ends ends) {
  const auto hit = [&samples](std::size_t i) -> Vector2d {
    return samples.directions[i] / samples.hits[i].inverse_distance;
  };
  std::vector<Segment> scene;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const bool first_is_farther = hit(i).norm() >= hit(i + 1).norm();
    const std::size_t chosen = first_is_farther == (rule == Radiance::kOfFartherEnd) ? i : i + 1;
    scene.push_back({"segment " + std::to_string(i), {hit(i), hit(i + 1)}, samples.hits[chosen].radiance});
  }
  if (ends == Ends::kContinuedBelow) {
    const Vector2d right = hit(0);
    const Vector2d left = hit(samples.size() - 1);
    scene.push_back({"right", {right, Vector2d(right.x() + 1.0, -1.0)}, samples.hits.front().radiance});
    scene.push_back({"left", {left, Vector2d(left.x() - 1.0, -1.0)}, samples.hits.back().radiance});
  }
  return scene;
}

double disagreement(const FlatlandEstimate& estimate, const std::vector<Segment>& scene) {
  const FlatlandEstimate truth = trueEstimate(scene, kOrigin);
  return (*estimate.gradient - *truth.gradient).norm() + (*estimate.hessian - *truth.hessian).norm() +
         std::abs(*estimate.tangential_hessian - *truth.tangential_hessian);
}

TEST(SamplePolyline, HasTheDerivativesOfTheSceneThatItIs) {
  for (const std::size_t count : {2u, 3u, 17u, 256u}) {
    const FlatlandSamples samples = randomSamples(count);
    const FlatlandEstimate open = estimateTriangulated(samples);
    const FlatlandEstimate closed = estimateTriangulatedClosed(samples);
    const std::vector<Segment> open_scene = polylineScene(samples, Radiance::kOfFartherEnd, Ends::kOpen);
    const std::vector<Segment> closed_scene = polylineScene(samples, Radiance::kOfFartherEnd, Ends::kContinuedBelow);
    // Terms of at most 2 u^2 = 8 a vertex, with 32 roundings each in either sum.
    const double bound = static_cast<double>(count) * 8.0 * 64.0 * 0x1p-53;
    EXPECT_LE(disagreement(open, open_scene), bound) << count;
    EXPECT_LE(disagreement(closed, closed_scene), bound) << count;
    EXPECT_GT(disagreement(open, closed_scene), 1e6 * bound);
    EXPECT_GT(disagreement(closed, open_scene), 1e6 * bound);
    EXPECT_GT(disagreement(open, polylineScene(samples, Radiance::kOfNearerEnd, Ends::kOpen)), 1e6 * bound);
    EXPECT_GT(disagreement(closed, polylineScene(samples, Radiance::kOfNearerEnd, Ends::kContinuedBelow)), 1e6 * bound);
  }
}

/// A segment from a hit to a miss is as a ray of the hit's direction to nowhere: the miss's radiance, the hit's place.
TEST(SamplePolyline, AMissIsInfinitelyFar) {
  FlatlandSamples samples = randomSamples(16);
  samples.hits[5].inverse_distance = 0.0;
  FlatlandSamples far = samples;
  far.hits[5].inverse_distance = 1e-9;
  for (const auto estimate : {estimateTriangulated, estimateTriangulatedClosed}) {
    EXPECT_LE((*estimate(samples).gradient - *estimate(far).gradient).norm(), 1e-8);
    EXPECT_LE((*estimate(samples).hessian - *estimate(far).hessian).norm(), 1e-8);
  }
}

TEST(SamplePolyline, OneSampleHasNone) {
  for (const auto estimate : {estimateTriangulated, estimateTriangulatedClosed}) {
    const FlatlandEstimate one = estimate(randomSamples(1));
    EXPECT_FALSE(one.gradient || one.hessian || one.tangential_hessian);
    EXPECT_GT(one.irradiance, 0.0);
  }
}

/// Only the tangential derivatives of the open polyline converge: what it lacks is beside the horizon.
TEST(SamplePolyline, ConvergesUnderOccluders) {
  for (const FlatlandStratification stratification :
       {FlatlandStratification::kCosine, FlatlandStratification::kSquare}) {
    const FlatlandCase setting{.stratification = stratification};
    const auto expectReached = [](const FlatlandConvergence& convergence) {
      EXPECT_TRUE(convergence.isReached()) << convergence;
      std::cout << convergence;
    };
    expectReached(
        flatlandConvergence("triangulated, dE/dt", setting, estimateTriangulated, tangentialGradientDifference));
    expectReached(flatlandConvergence("triangulated, tangential Hessian", setting, estimateTriangulated,
                                      tangentialHessianDifference));
    expectReached(
        flatlandConvergence("triangulated-closed, gradient", setting, estimateTriangulatedClosed, gradientDifference));
    expectReached(
        flatlandConvergence("triangulated-closed, Hessian", setting, estimateTriangulatedClosed, hessianDifference));
    const FlatlandConvergence open =
        flatlandConvergence("triangulated, Hessian", setting, estimateTriangulated, hessianDifference);
    EXPECT_FALSE(open.isReached()) << open;
    std::cout << open;
  }
}

/// The sum of the segments, of which none hides another.
FlatlandEstimate sumOfSegments(const std::vector<Segment>& segments) {
  FlatlandEstimate sum;
  sum.hessian = Matrix2d::Zero();
  for (const Segment& segment : segments) {
    *sum.hessian += segment.radiance * evaluateSegment(segment, 0, kOrigin).derivatives.hessian.value;
  }
  return sum;
}

TEST(SamplePolyline, TheNearerRadianceDoesNotConverge) {
  for (const Radiance rule : {Radiance::kOfFartherEnd, Radiance::kOfNearerEnd}) {
    const FlatlandConvergence hessian = flatlandConvergence(
        "by segments", {},
        [rule](const FlatlandSamples& samples) {
          return sumOfSegments(polylineScene(samples, rule, Ends::kContinuedBelow));
        },
        hessianDifference);
    EXPECT_EQ(hessian.isReached(), rule == Radiance::kOfFartherEnd) << hessian;
  }
}

/// In a room of one radiance the derivatives are 0. What the open polyline lacks is below its outermost samples.
TEST(SamplePolyline, ConstantRadiance) {
  const std::vector<Segment> room = flatRoom(1.0);
  const FlatlandReceiver receiver{Vector2d(0.4, 0.1), Vector2d::UnitY()};
  for (const std::size_t count : {64u, 4096u}) {
    const FlatlandSamples samples =
        sampleJittered({FlatlandStratification::kCosine, count}, 1, rayCaster(room, receiver));
    const FlatlandEstimate closed = estimateTriangulatedClosed(samples);
    EXPECT_EQ(*closed.gradient, Vector2d::Zero());
    EXPECT_EQ(*closed.hessian, Matrix2d::Zero());
    const FlatlandEstimate open = estimateTriangulated(samples);
    EXPECT_GT(open.hessian->norm(), 1e-3);
    std::cout << "constant radiance, open polyline, N=" << count << ": |gradient| " << open.gradient->norm()
              << " |Hessian| " << open.hessian->norm() << " |tangential Hessian| " << std::abs(*open.tangential_hessian)
              << '\n';
  }
}

}  // namespace
}  // namespace irradiff
