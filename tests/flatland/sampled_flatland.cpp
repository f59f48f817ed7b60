#include "tests/flatland/sampled_flatland.h"

#include "derivatives/flatland/flatland_scene.h"
#include "tests/estimators/convergence_order.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace irradiff {

using Eigen::Vector2d;

namespace {

double area(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

FlatlandRayQuery rayCaster(std::span<const Segment> scene, const FlatlandReceiver& receiver) {
  const Eigen::Matrix2d axes = flatlandFrame(receiver.normal);
  return [scene, axes, position = receiver.position](const Vector2d& direction) {
    const Vector2d w = axes * direction;
    FlatlandHit nearest;
    for (const Segment& segment : scene) {
      const Vector2d a = segment.vertices[0] - position;
      const Vector2d b = segment.vertices[1] - position;
      // The ray crosses the segment if the ends are on its two sides and the crossing is ahead.
      const double side_a = area(w, a);
      const double side_b = area(w, b);
      if (side_a * side_b > 0.0) continue;
      const double inverse_distance = area(w, b - a) / area(a, b - a);
      if (inverse_distance > nearest.inverse_distance && std::isfinite(inverse_distance)) {
        nearest = {inverse_distance, segment.radiance};
      }
    }
    return nearest;
  };
}

FlatlandSamples sampleCentred(const FlatlandStrata& strata, const FlatlandRayQuery& cast_ray) {
  return sampleHalfCircle(strata, std::vector<double>(strata.count(), 0.5), cast_ray);
}

FlatlandSamples sampleJittered(const FlatlandStrata& strata, std::uint64_t seed, const FlatlandRayQuery& cast_ray) {
  KeyedRandom random(seed, "flatland samples", strata.count());
  std::vector<double> offsets(strata.count());
  for (double& offset : offsets) offset = random.unit();
  return sampleHalfCircle(strata, offsets, cast_ray);
}

FlatlandEstimate trueEstimate(std::span<const Segment> scene, const FlatlandReceiver& receiver) {
  const SceneEvaluation<2> evaluation = evaluateScene(scene, receiver);
  EXPECT_EQ(evaluation.no_gradient, "");
  EXPECT_EQ(evaluation.no_tangential_hessian, "");
  const Eigen::Matrix2d to_frame = flatlandFrame(receiver.normal).transpose();
  FlatlandEstimate truth;
  truth.irradiance = evaluation.derivatives.irradiance.value;
  truth.rotational_gradient = evaluation.derivatives.rotational_gradient.value(0);
  truth.gradient = to_frame * evaluation.derivatives.gradient.value;
  truth.knows_normal_component = true;
  truth.hessian = to_frame * evaluation.derivatives.hessian.value * to_frame.transpose();
  truth.tangential_hessian = evaluation.derivatives.tangential_hessian.value(0, 0);
  return truth;
}

std::vector<Segment> furnishedRoom() {
  return {{"lamp", {Vector2d(-0.9, 1.4), Vector2d(1.1, 1.7)}, 3.0},
          {"dark", {Vector2d(-0.5, 0.6), Vector2d(-0.15, 0.65)}, 0.0},
          {"dim", {Vector2d(0.2, 0.9), Vector2d(0.55, 0.8)}, 0.5},
          {"east", {Vector2d(1.5, -2.0), Vector2d(1.5, 2.2)}, 0.4},
          {"ceiling", {Vector2d(1.5, 2.2), Vector2d(-1.5, 2.2)}, 0.8},
          {"west", {Vector2d(-1.5, 2.2), Vector2d(-1.5, -2.0)}, 0.4}};
}

std::vector<Segment> tiltedLamp() { return {{"lamp", {Vector2d(-0.4, 0.8), Vector2d(1.0, 1.5)}, 3.0}}; }

std::vector<Segment> levelLamp() { return {{"lamp", {Vector2d(-0.3, 1.2), Vector2d(0.45, 1.2)}, 3.0}}; }

std::vector<Segment> flatRoom(double radiance) {
  return {{"east", {Vector2d(1.0, 0.0), Vector2d(1.0, 2.0)}, radiance},
          {"ceiling", {Vector2d(1.0, 2.0), Vector2d(-1.0, 2.0)}, radiance},
          {"west", {Vector2d(-1.0, 2.0), Vector2d(-1.0, 0.0)}, radiance}};
}

std::vector<FlatlandReceiver> flatlandReceivers(std::size_t count, double tilt) {
  std::vector<FlatlandReceiver> receivers;
  KeyedRandom random(1, "flatland receivers", 0);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.between(-0.5, 0.5);
    const double angle = random.between(-tilt, tilt);
    receivers.push_back({Vector2d(x, 0.0), Vector2d(std::sin(angle), std::cos(angle))});
  }
  return receivers;
}

double FlatlandConvergence::order() const { return convergenceOrder(sizes, errors); }

std::ostream& operator<<(std::ostream& out, const FlatlandConvergence& convergence) {
  out << convergence.what << ": order " << convergence.order() << ", median relative errors";
  for (std::size_t i = 0; i < convergence.sizes.size(); ++i) {
    out << "  N=" << convergence.sizes[i] << " " << convergence.errors[i];
  }
  return out << '\n';
}

FlatlandConvergence flatlandConvergence(const std::string& what, const FlatlandCase& setting,
                                        const FlatlandEstimateOf& estimate, const FlatlandErrorOf& error,
                                        const FlatlandTruthOf& truth) {
  constexpr std::size_t kReceivers = 51;
  const std::vector<FlatlandReceiver> receivers = flatlandReceivers(kReceivers, setting.tilt);
  std::vector<FlatlandEstimate> truths;
  truths.reserve(kReceivers);
  for (const FlatlandReceiver& receiver : receivers) truths.push_back(truth(setting.scene, receiver));
  FlatlandConvergence result{what, {64, 256, 1024, 4096}, {}};
  for (const std::size_t count : result.sizes) {
    const FlatlandStrata strata(setting.stratification, count);
    std::vector<double> errors;
    for (std::size_t i = 0; i < kReceivers; ++i) {
      const FlatlandSamples samples = sampleJittered(strata, i, rayCaster(setting.scene, receivers[i]));
      errors.push_back(error(estimate(samples), truths[i]));
    }
    std::nth_element(errors.begin(), errors.begin() + kReceivers / 2, errors.end());
    result.errors.push_back(errors[kReceivers / 2]);
  }
  return result;
}

double gradientDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth) {
  return (estimate.gradient.value() - truth.gradient.value()).norm() / truth.gradient->norm();
}

double tangentialGradientDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth) {
  return std::abs(estimate.gradient.value().x() - truth.gradient.value().x()) / std::abs(truth.gradient->x());
}

double hessianDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth) {
  return (estimate.hessian.value() - truth.hessian.value()).norm() / truth.hessian->norm();
}

double tangentialHessianDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth) {
  return std::abs(estimate.tangential_hessian.value() - truth.tangential_hessian.value()) /
         std::abs(*truth.tangential_hessian);
}

double irradianceDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth) {
  return std::abs(estimate.irradiance - truth.irradiance) / std::abs(truth.irradiance);
}

double rotationalDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth) {
  return std::abs(estimate.rotational_gradient - truth.rotational_gradient) / std::abs(truth.rotational_gradient);
}

}  // namespace irradiff
