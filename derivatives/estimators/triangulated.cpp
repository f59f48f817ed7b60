#include "derivatives/estimators/triangulated.h"

#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/estimators/strata_sums.h"
#include "derivatives/samples/sample_mesh.h"

#include <memory>

namespace irradiff {

namespace {

class Triangulated : public Estimator {
 public:
  Triangulated(Stratification stratification, GridShape shape, MeshRim rim)
      : sums_(stratification, shape), mesh_(stratification, shape, rim) {}

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    IrradianceEstimate result;
    result.irradiance = sums_.irradiance(samples);
    result.rotational_gradient = sums_.rotationalGradient(samples);
    if (mesh_.isEmpty()) return result;
    const MeshDerivatives derivatives = meshDerivatives(
        mesh_,
        {samples.direction_t, samples.direction_b, samples.direction_n, samples.inverse_distance, samples.radiance});
    result.setPositionDerivatives(derivatives.gradient, derivatives.hessian);
    return result;
  }

 private:
  StrataSums sums_;
  SampleMesh mesh_;
};

}  // namespace

std::unique_ptr<Estimator> makeTriangulated(Stratification stratification, GridShape shape) {
  return std::make_unique<Triangulated>(stratification, shape, MeshRim::kOpen);
}

std::unique_ptr<Estimator> makeTriangulatedClosed(Stratification stratification, GridShape shape) {
  return std::make_unique<Triangulated>(stratification, shape, MeshRim::kDownToHorizon);
}

}  // namespace irradiff
