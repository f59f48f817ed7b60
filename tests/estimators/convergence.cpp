#include "tests/estimators/convergence.h"

#include "derivatives/estimators/estimator.h"
#include "tests/estimators/convergence_order.h"

#include <Eigen/Geometry>

#include <memory>

namespace irradiff {

using Eigen::Vector3d;

double Convergence::order() const { return convergenceOrder(sizes, errors); }

std::ostream& operator<<(std::ostream& out, const Convergence& convergence) {
  out << convergence.what << ": order " << convergence.order() << ", median relative errors";
  for (std::size_t i = 0; i < convergence.sizes.size(); ++i) {
    out << "  n=" << convergence.sizes[i] << " " << convergence.errors[i];
  }
  return out << '\n';
}

namespace {

constexpr std::size_t kReceivers = 25;

Convergence measured(const std::function<EstimateOf(const Strata&)>& prepare, Stratification stratification,
                     const std::vector<Polygon>& scene, const ErrorOf& error, const TruthOf& truth) {
  Convergence result{std::string(nameOf(stratification)), {16, 32, 64, 128}, {}};
  std::vector<SceneDerivatives> truths;
  const std::vector<Vector3d> positions = receivers(kReceivers, 0.5);
  truths.reserve(positions.size());
  for (const Vector3d& position : positions) truths.push_back(truth(scene, frameAt(position)));
  for (const std::size_t n : result.sizes) {
    const Strata strata = strataOfSize(stratification, n);
    const EstimateOf estimate = prepare(strata);
    std::vector<double> errors;
    errors.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const HemisphereSamples samples =
          sampleScene(scene, frameAt(positions[i]), strata, SamplePlaces::jittered(1000 * n + i + 1));
      errors.push_back(error(estimate(samples), truths[i]));
    }
    result.errors.push_back(median(errors));
  }
  return result;
}

}  // namespace

Convergence convergence(const EstimateOf& estimate, Stratification stratification, const std::vector<Polygon>& scene,
                        const ErrorOf& error, const TruthOf& truth) {
  return measured([&](const Strata&) { return estimate; }, stratification, scene, error, truth);
}

Convergence convergence(std::string_view estimator, Stratification stratification, const std::vector<Polygon>& scene,
                        const ErrorOf& error, const TruthOf& truth) {
  const auto prepare = [&](const Strata& strata) -> EstimateOf {
    const std::shared_ptr<Estimator> made = makeEstimator(estimator, strata.stratification(), strata.shape());
    return [made](const HemisphereSamples& samples) { return made->estimate(samples); };
  };
  return measured(prepare, stratification, scene, error, truth);
}

double tangentialGradientError(const IrradianceEstimate& estimate, const SceneDerivatives& truth) {
  return (estimate.gradient.value().head<2>() - truth.tangentialGradient()).norm() / truth.tangentialGradient().norm();
}

double gradientError(const IrradianceEstimate& estimate, const SceneDerivatives& truth) {
  return (estimate.gradient.value() - truth.gradient).norm() / truth.gradient.norm();
}

double rotationalGradientError(const IrradianceEstimate& estimate, const SceneDerivatives& truth) {
  return (estimate.rotational_gradient.value() - truth.rotational_gradient).norm() / truth.rotational_gradient.norm();
}

double hessianError(const IrradianceEstimate& estimate, const SceneDerivatives& truth) {
  return (estimate.hessian.value() - truth.hessian).norm() / truth.hessian.norm();
}

double tangentialHessianError(const IrradianceEstimate& estimate, const SceneDerivatives& truth) {
  return (estimate.tangential_hessian.value() - truth.tangentialHessian()).norm() / truth.tangentialHessian().norm();
}

std::vector<Polygon> tiltedEmitter() {
  return {parallelogram("tilted", {0.3, 0.2, 1.2}, {0.6, 0.1, 0.25}, {-0.1, 0.5, -0.2}, 3.0)};
}

std::vector<Polygon> levelEmitter() {
  return {parallelogram("level", {0.1, 0.05, 1.2}, {0.45, 0.1, 0.0}, {-0.1, 0.4, 0.0}, 3.0)};
}

std::vector<Polygon> occludedEmitter() {
  return {parallelogram("emitter", {0.1, 0.2, 1.5}, {0.8, 0.1, 0.0}, {-0.1, 0.7, 0.0}, 3.0),
          parallelogram("low", {-0.2, 0.1, 0.6}, {0.2, 0.05, 0.0}, {0.0, 0.2, 0.1}, 0.0),
          parallelogram("high", {0.3, -0.1, 0.9}, {0.15, 0.0, 0.0}, {0.05, 0.25, 0.0}, 0.5)};
}

std::vector<Polygon> closedScene(std::vector<Polygon> scene) {
  const double far = 50.0;
  for (Polygon wall : room(0.0)) {
    for (Vector3d& corner : wall.vertices) corner *= far;
    scene.push_back(wall);
  }
  return scene;
}

}  // namespace irradiff
