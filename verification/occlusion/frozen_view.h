#pragma once

#include "derivatives/visibility/scene_evaluation.h"
#include "verification/multiprecision/multiprecision.h"
#include "verification/occlusion/occluded_scene.h"

namespace irradiff {

/// What one receiver sees of a scene, its topology frozen: irradiance from there as a function of the position at 200
/// digits. Trusts the topology and Lambert's sum, and knows no formula for a derivative.
class FrozenView {
 public:
  /// Throws InvalidScene as SceneEvaluator does.
  explicit FrozenView(const OccludedScene& scene);

  const VisibleBoundary& view() const { return view_; }

  /// W/m^2.
  Multiprecision irradiance(const MultiprecisionVector& position) const;

  struct Derivatives {
    Multiprecision irradiance;
    MultiprecisionVector gradient;
    MultiprecisionMatrix hessian;
  };

  /// By nested Jets on irradiance: cuts depend on the position, so that the motion of everything is in, apparent
  /// vertices included.
  Derivatives differentiated() const;

  /// The library's formulas at 200 digits, for the bounds of rounding errors.
  IrradianceDerivatives<Multiprecision> formulas() const;

 private:
  template <class Scalar>
  Scalar irradianceAt(const Vector3<Scalar>& position) const;

  OccludedScene scene_;
  std::vector<double> radiances_;
  SceneEvaluator evaluator_;
  VisibleBoundary view_;
};

}  // namespace irradiff
