// Derivatives from the mesh over hemisphere samples against those of scenes: what the open rim costs, which depth of
// the closed one is best, how fast they converge.

#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/samples/sample_mesh.h"
#include "derivatives/samples/strata.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "tests/estimators/convergence.h"
#include "tests/estimators/convergence_order.h"
#include "tests/estimators/sampled_scene.h"
#include "tests/estimators/triangle_sum.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

constexpr MeshRim kRims[] = {MeshRim::kOpen, MeshRim::kDownToHorizon};

MeshDerivatives estimated(MeshRim rim, const HemisphereSamples& samples) {
  return meshDerivatives(
      {samples.stratification, samples.shape, rim},
      {samples.direction_t, samples.direction_b, samples.direction_n, samples.inverse_distance, samples.radiance});
}

/// The room with walls of different radiance and a black square in it.
std::vector<Polygon> colouredRoom() {
  std::vector<Polygon> scene = room(1.0);
  const std::vector<double> radiances{0.9, 0.3, 0.6, 0.1, 1.5};
  for (std::size_t i = 0; i < scene.size(); ++i) scene[i].radiance = radiances[i];
  scene.push_back(parallelogram("square", {0.0, 0.0, 0.5}, {0.35, 0.0, 0.0}, {0.0, 0.35, 0.0}, 0.0));
  return scene;
}

/// The room of one radiance with the black square.
std::vector<Polygon> occludedRoom() {
  std::vector<Polygon> scene = room(1.0);
  scene.push_back(parallelogram("square", {0.0, 0.0, 0.5}, {0.35, 0.0, 0.0}, {0.0, 0.35, 0.0}, 0.0));
  return scene;
}

/// Errors of gradient and Hessian in the tangent plane, relative to the largest component, at each receiver.
struct SceneErrors {
  std::vector<double> gradient, hessian;
};

using DerivativesOf = std::function<MeshDerivatives(const HemisphereSamples&)>;

SceneErrors sceneErrors(const std::vector<Polygon>& scene, std::size_t n, const DerivativesOf& derivativesOf) {
  SceneErrors errors;
  for (const Eigen::Vector3d& position : receivers(200, 0.9)) {
    const SceneDerivatives truth = trueDerivatives(scene, frameAt(position));
    const MeshDerivatives value =
        derivativesOf(sampleScene(scene, frameAt(position), {Stratification::kConcentric, {n, n}},
                                  SamplePlaces::jittered(errors.gradient.size() + 1)));
    const Eigen::Vector2d true_gradient = truth.tangentialGradient();
    const Eigen::Matrix2d true_hessian = truth.tangentialHessian();
    errors.gradient.push_back((value.gradient.head<2>() - true_gradient).cwiseAbs().maxCoeff() /
                              true_gradient.cwiseAbs().maxCoeff());
    errors.hessian.push_back((value.hessian.topLeftCorner<2, 2>() - true_hessian).cwiseAbs().maxCoeff() /
                             true_hessian.cwiseAbs().maxCoeff());
  }
  return errors;
}

/// How many standard deviations the number of places where `a` is the larger is above half of those where they differ.
double timesLarger(const std::vector<double>& a, const std::vector<double>& b) {
  double larger = 0.0;
  double different = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    larger += a[i] > b[i] ? 1.0 : 0.0;
    different += a[i] != b[i] ? 1.0 : 0.0;
  }
  return different > 0.0 ? (larger - 0.5 * different) / (0.5 * std::sqrt(different)) : 0.0;
}

/// What the published mesh makes of nothing, in numbers.
TEST(TriangulatedScenes, OpenMeshSeesDerivativesInConstantRadiance) {
  const std::vector<Polygon> scene = room(1.0);
  for (const std::size_t n : {16U, 32U, 64U}) {
    std::vector<double> gradients, hessians;
    for (const Eigen::Vector3d& position : receivers(25, 0.9)) {
      const HemisphereSamples samples = sampleScene(scene, frameAt(position), {Stratification::kConcentric, {n, n}},
                                                    SamplePlaces::jittered(hessians.size() + 1));
      const MeshDerivatives open = estimated(MeshRim::kOpen, samples);
      gradients.push_back(open.gradient.head<2>().norm());
      hessians.push_back(open.hessian.topLeftCorner<2, 2>().norm());
    }
    std::cout << n << " x " << n << " rays in a room of radiance 1, open mesh: median |grad| " << median(gradients)
              << ", |H| " << median(hessians) << " in the tangent plane; the truth is 0\n";
    EXPECT_GT(median(hessians), 0.0);
  }
}

/// Two half planes of different radiance above, wide enough for their ends not to count.
std::vector<Polygon> twoTonedCeiling() {
  return {parallelogram("left", {-20.0, 0.0, 1.0}, {20.0, 0.0, 0.0}, {0.0, 40.0, 0.0}, 1.0),
          parallelogram("right", {20.0, 0.0, 1.0}, {20.0, 0.0, 0.0}, {0.0, 40.0, 0.0}, 0.3)};
}

TEST(TriangulatedScenes, RimAtInfinityIsAsAccurateAsAnyOther) {
  struct RimCase {
    const char* name;
    RimDepth depth;
    bool is_bad = false;
  };
  const RimCase others[] = {
      {"straight down", [](double inverse_distance, double sine) { return inverse_distance / sine; }},
      {"as far as the sample", [](double inverse_distance, double) { return inverse_distance; }},
      {"at a tenth of its distance", [](double inverse_distance, double) { return 10.0 * inverse_distance; }, true}};
  for (const std::size_t n : {8U, 24U}) {
    const SampleMesh mesh(Stratification::kConcentric, {n, n}, MeshRim::kDownToHorizon);
    for (const auto& [scene_name, scene] :
         {std::pair{"coloured room", colouredRoom()}, {"two-toned ceiling", twoTonedCeiling()}}) {
      const auto errorsOf = [&, &radiances = scene](const char* name, const RimDepth& depth) {
        SceneErrors errors = sceneErrors(radiances, n, [&](const HemisphereSamples& samples) {
          return rounded(triangleSum(meshVertices<double>(mesh, samples, depth), radiantTriangles(mesh, samples)));
        });
        std::cout << n << " x " << n << ", rim " << name << ": median error " << median(errors.gradient)
                  << " (gradient), " << median(errors.hessian) << " (Hessian)\n";
        return errors;
      };
      std::cout << scene_name << '\n';
      const SceneErrors at_infinity = errorsOf("at infinity", atInfinity);
      for (const RimCase& other : others) {
        const SceneErrors errors = errorsOf(other.name, other.depth);
        EXPECT_LT(timesLarger(at_infinity.gradient, errors.gradient), 3.0) << other.name;
        EXPECT_LT(timesLarger(at_infinity.hessian, errors.hessian), 3.0) << other.name;
        if (!other.is_bad) continue;
        EXPECT_GT(timesLarger(errors.gradient, at_infinity.gradient), 3.0) << other.name;
        EXPECT_GT(timesLarger(errors.hessian, at_infinity.hessian), 3.0) << other.name;
      }
    }
  }
}

TEST(TriangulatedScenes, ConvergesAsTheNumberOfRowsAndIsBetterClosed) {
  const std::vector<std::size_t> sizes{16, 32, 64};
  std::vector<double> gradients[2], hessians[2];
  for (const std::size_t n : sizes) {
    for (const MeshRim rim : kRims) {
      const std::size_t which = rim == MeshRim::kOpen ? 0 : 1;
      const SceneErrors errors =
          sceneErrors(occludedRoom(), n, [rim](const HemisphereSamples& samples) { return estimated(rim, samples); });
      gradients[which].push_back(median(errors.gradient));
      hessians[which].push_back(median(errors.hessian));
      std::cout << "occluded room, " << n << " x " << n << ", " << (which == 0 ? "open" : "closed") << ": median error "
                << gradients[which].back() << " (gradient), " << hessians[which].back() << " (Hessian)\n";
    }
    EXPECT_LT(gradients[1].back(), gradients[0].back());
    EXPECT_LT(hessians[1].back(), hessians[0].back());
  }
  for (const std::size_t which : {0U, 1U}) {
    const double gradient_order = convergenceOrder(sizes, gradients[which]);
    const double hessian_order = convergenceOrder(sizes, hessians[which]);
    std::cout << "order in the number of rows: " << gradient_order << " (gradient), " << hessian_order
              << " (Hessian)\n";
    // First order, less what 200 receivers leave open; a mesh with a fault has order 0.
    EXPECT_GT(gradient_order, 0.7);
    EXPECT_GT(hessian_order, 0.7);
  }
}

/// The mesh fills the gaps: its Hessian is that of the gap-filled scene, in which apparent vertices do not move.
TEST(TriangulatedScenes, HessianTendsToThatOfTheGapFilledScene) {
  const std::vector<Polygon> scene = colouredRoom();
  const SceneEvaluator evaluator(scene);
  double closest_to_filled = 1.0;
  for (const std::size_t n : {32U, 128U}) {
    std::vector<double> from_filled, from_truth;
    for (const Eigen::Vector3d& position : receivers(100, 0.9)) {
      const Receiver receiver{position, Eigen::Vector3d::UnitZ()};
      const auto hessianWith = [&](ApparentVertices vertices) {
        return Eigen::Matrix2d(
            evaluator.evaluate(receiver, evaluator.view(receiver), vertices).derivatives.tangential_hessian.value);
      };
      const Eigen::Matrix2d value =
          estimated(MeshRim::kDownToHorizon,
                    sampleScene(scene, frameAt(position), {Stratification::kConcentric, {n, n}},
                                SamplePlaces::jittered(from_filled.size() + 1)))
              .hessian.topLeftCorner<2, 2>();
      const auto errorFrom = [&value](const Eigen::Matrix2d& hessian) {
        return (value - hessian).cwiseAbs().maxCoeff() / hessian.cwiseAbs().maxCoeff();
      };
      from_filled.push_back(errorFrom(hessianWith(ApparentVertices::kFixed)));
      from_truth.push_back(errorFrom(hessianWith(ApparentVertices::kMove)));
    }
    std::cout << "coloured room, " << n << " x " << n << ": median error of the Hessian " << median(from_filled)
              << " from the gap-filled scene, " << median(from_truth) << " from the scene\n";
    EXPECT_LT(median(from_filled), 0.5 * closest_to_filled);
    closest_to_filled = median(from_filled);
    if (n == 128) {
      EXPECT_GT(median(from_truth), 1.5 * median(from_filled));
    }
  }
}

}  // namespace
}  // namespace irradiff
