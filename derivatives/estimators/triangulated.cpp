#include "derivatives/estimators/triangulated.h"

#include "derivatives/estimators/mesh_sums.h"
#include "derivatives/estimators/strata_sums.h"
#include "derivatives/samples/sample_mesh.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace irradiff {

namespace {

/// sin of the angle to the normal below which a hit counts as this far from it: the wall below a hit almost straight
/// above would pass through the receiver.
constexpr double kSmallestSine = 0.5;

/// Where the walls below the outermost samples meet the receiver's plane.
struct HorizonVertices {
  std::vector<double> t, b, n, inverse_distance;

  HorizonVertices(const HemisphereSamples& samples, const std::vector<std::size_t>& outermost_samples)
      : n(outermost_samples.size(), 0.0) {
    t.reserve(n.size());
    b.reserve(n.size());
    inverse_distance.reserve(n.size());
    for (const std::size_t sample : outermost_samples) {
      const double sample_t = samples.direction_t[sample];
      const double sample_b = samples.direction_b[sample];
      const double sine = std::hypot(sample_t, sample_b);
      // The wall below a hit exactly above stands towards t.
      t.push_back(sine > 0.0 ? sample_t / sine : 1.0);
      b.push_back(sine > 0.0 ? sample_b / sine : 0.0);
      inverse_distance.push_back(samples.inverse_distance[sample] / std::max(sine, kSmallestSine));
    }
  }

  MeshVertices vertices() const { return {t, b, n, inverse_distance}; }
};

class Triangulated : public Estimator {
 public:
  Triangulated(Stratification stratification, GridShape shape, MeshRim rim)
      : sums_(stratification, shape), mesh_(stratification, shape, rim), rim_(rim) {}

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    IrradianceEstimate result;
    result.irradiance = sums_.irradiance(samples);
    result.rotational_gradient = sums_.rotationalGradient(samples);
    if (mesh_.isEmpty()) return result;
    const MeshDerivatives derivatives = derivativesOf(samples);
    if (derivatives.gradient.allFinite()) {
      result.gradient = derivatives.gradient;
      result.knows_normal_component = true;
    }
    if (derivatives.hessian.allFinite()) {
      result.hessian = derivatives.hessian;
      result.tangential_hessian = derivatives.hessian.topLeftCorner<2, 2>();
    }
    return result;
  }

 private:
  MeshDerivatives derivativesOf(const HemisphereSamples& samples) const {
    const MeshVertices vertices{samples.direction_t, samples.direction_b, samples.direction_n,
                                samples.inverse_distance};
    if (rim_ == MeshRim::kOpen) return meshDerivatives(mesh_, vertices, samples.radiance, {});
    const HorizonVertices horizon(samples, mesh_.outermostSamples());
    return meshDerivatives(mesh_, vertices, samples.radiance, horizon.vertices());
  }

  StrataSums sums_;
  SampleMesh mesh_;
  MeshRim rim_;
};

}  // namespace

std::unique_ptr<Estimator> makeTriangulated(Stratification stratification, GridShape shape) {
  return std::make_unique<Triangulated>(stratification, shape, MeshRim::kOpen);
}

std::unique_ptr<Estimator> makeTriangulatedClosed(Stratification stratification, GridShape shape) {
  return std::make_unique<Triangulated>(stratification, shape, MeshRim::kDownToHorizon);
}

}  // namespace irradiff
