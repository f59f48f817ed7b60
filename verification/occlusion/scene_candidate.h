#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/checks/candidate.h"
#include "verification/occlusion/occluded_scene.h"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace irradiff {

/// What is judged of a scene.
inline constexpr std::array<Quantity, 3> kSceneQuantities = {Quantity::kIrradiance, Quantity::kGradient,
                                                             Quantity::kHessian};

/// What an evaluator of occluded scenes returns for one receiver. W/m^2, W/m^3, W/m^4, derivatives with respect to the
/// receiver's position. Leave out what you do not have.
struct SceneResult {
  double irradiance = 0.0;
  std::optional<Eigen::Vector3d> gradient;
  std::optional<Eigen::Matrix3d> hessian;
  /// Bounds that the candidate claims for its absolute errors; checked where given.
  std::optional<DerivativeBounds> bounds;

  /// The quantity as a 1 x 1, 3 x 1 or 3 x 3 matrix, if there is one.
  std::optional<Eigen::MatrixXd> get(Quantity quantity) const;
};

/// What is put to the test: your own irradiance of a scene of polygons that hide each other.
///
///     const SceneCandidate mine{"mine", [](const OccludedScene& scene) {
///       return SceneResult{myIrradiance(scene.polygons, scene.receiver.position, scene.receiver.normal)};
///     }};
///     std::cout << summarize(checkOcclusion(mine, {}));
///
/// A candidate that throws or returns NaN fails the check.
struct SceneCandidate {
  std::string name;
  std::function<SceneResult(const OccludedScene&)> evaluate;
};

/// SceneEvaluator with its bounds; a quantity that does not exist at the receiver is left out.
SceneCandidate libraryEvaluator(ApparentVertices vertices = ApparentVertices::kMove);

}  // namespace irradiff
