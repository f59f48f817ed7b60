#pragma once

#include "derivatives/estimators/irradiance_estimate.h"
#include "tests/estimators/sampled_scene.h"

#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// Median relative errors of an estimator over receivers, on finer and finer strata with jittered samples.
struct Convergence {
  std::string what;
  std::vector<std::size_t> sizes;
  std::vector<double> errors;

  double order() const;

  /// An edge is found to within a stratum, so that an error of first order in 1/n remains at worst. Half of that is
  /// asked for, which a bias does not reach: from n = 16 to 128 the errors must fall to 0.35.
  bool isReached() const { return order() >= 0.5; }
};

std::ostream& operator<<(std::ostream& out, const Convergence& convergence);

using EstimateOf = std::function<IrradianceEstimate(const HemisphereSamples&)>;
using ErrorOf = std::function<double(const IrradianceEstimate&, const SceneDerivatives&)>;

/// What the error is relative to, at one receiver.
using TruthOf = std::function<SceneDerivatives(const std::vector<Polygon>&, const SampleFrame&)>;

Convergence convergence(const EstimateOf& estimate, Stratification stratification, const std::vector<Polygon>& scene,
                        const ErrorOf& error, const TruthOf& truth = trueDerivatives);

/// Of an estimator of the catalogue.
Convergence convergence(std::string_view estimator, Stratification stratification, const std::vector<Polygon>& scene,
                        const ErrorOf& error, const TruthOf& truth = trueDerivatives);

double tangentialGradientError(const IrradianceEstimate& estimate, const SceneDerivatives& truth);
double gradientError(const IrradianceEstimate& estimate, const SceneDerivatives& truth);
double rotationalGradientError(const IrradianceEstimate& estimate, const SceneDerivatives& truth);
double hessianError(const IrradianceEstimate& estimate, const SceneDerivatives& truth);
double tangentialHessianError(const IrradianceEstimate& estimate, const SceneDerivatives& truth);

/// Nothing hides anything.
std::vector<Polygon> tiltedEmitter();
/// Parallel to the receivers' plane, and seen through the top face of a hemicube alone.
std::vector<Polygon> levelEmitter();
/// Two dark occluders at different heights below an emitter.
std::vector<Polygon> occludedEmitter();

/// With dark walls far out, so that every ray hits something.
std::vector<Polygon> closedScene(std::vector<Polygon> scene);

}  // namespace irradiff
