#include "derivatives/estimators/geometric.h"

#include "derivatives/estimators/strata_sums.h"
#include "derivatives/estimators/surface_patches.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace irradiff {

Eigen::Matrix2d absoluteValue(const Eigen::Matrix2d& matrix) {
  const double size = matrix.cwiseAbs().maxCoeff();
  if (size == 0.0) return matrix;
  // The determinant of the matrix itself may be out of range where its entries are not.
  const Eigen::Matrix2d m = matrix / size;
  const double trace = m.trace();
  const double determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1);
  if (determinant >= 0.0) return trace < 0.0 ? Eigen::Matrix2d(-matrix) : matrix;
  // Eigenvalues of both signs: |M| = (M^2 - det I) / (l1 - l2), and M^2 = tr M - det I.
  return size / std::sqrt(trace * trace - 4.0 * determinant) *
         (trace * m - 2.0 * determinant * Eigen::Matrix2d::Identity());
}

namespace {

class Geometric final : public Estimator {
 public:
  Geometric(Stratification stratification, GridShape shape)
      : sums_(stratification, shape), patches_(Strata(stratification, shape)) {}

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    const std::vector<Eigen::Vector3d> planes = patches_.inversePlanes(samples);
    Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < samples.shape.size(); ++i) {
      curvature += absoluteValue(patches_.derivatives(samples, i, planes[i]).hessian.topLeftCorner<2, 2>());
    }
    IrradianceEstimate estimate;
    estimate.irradiance = sums_.irradiance(samples);
    estimate.rotational_gradient = sums_.rotationalGradient(samples);
    estimate.tangential_hessian = estimate.irradiance / std::numbers::pi * curvature;
    return estimate;
  }

 private:
  StrataSums sums_;
  SurfacePatches patches_;
};

}  // namespace

std::unique_ptr<Estimator> makeGeometric(Stratification stratification, GridShape shape) {
  return std::make_unique<Geometric>(stratification, shape);
}

}  // namespace irradiff
