#include "derivatives/estimators/radiometric.h"

#include "derivatives/estimators/strata_sums.h"
#include "derivatives/estimators/surface_patches.h"

#include <vector>

namespace irradiff {

namespace {

class Radiometric final : public Estimator {
 public:
  Radiometric(Stratification stratification, GridShape shape)
      : sums_(stratification, shape), patches_(Strata(stratification, shape)) {}

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    const std::vector<Eigen::Vector3d> planes = patches_.inversePlanes(samples);
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < samples.shape.size(); ++i) {
      if (samples.radiance[i] == 0.0) continue;
      const PatchDerivatives patch = patches_.derivatives(samples, i, planes[i]);
      gradient += samples.radiance[i] * patch.gradient;
      hessian += samples.radiance[i] * patch.hessian;
    }
    IrradianceEstimate estimate;
    estimate.irradiance = sums_.irradiance(samples);
    estimate.rotational_gradient = sums_.rotationalGradient(samples);
    estimate.setPositionDerivatives(gradient, hessian);
    return estimate;
  }

 private:
  StrataSums sums_;
  SurfacePatches patches_;
};

}  // namespace

std::unique_ptr<Estimator> makeRadiometric(Stratification stratification, GridShape shape) {
  return std::make_unique<Radiometric>(stratification, shape);
}

}  // namespace irradiff
