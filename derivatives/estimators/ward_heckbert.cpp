#include "derivatives/estimators/ward_heckbert.h"

#include "derivatives/estimators/strata_sums.h"
#include "derivatives/estimators/strata_walls.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace irradiff {

namespace {

/// The published rotation gradient, for the rotation vector:
//   g = pi/(M N) sum_k v_k sum_j tan(theta_j) L_jk,   sin^2(theta_j) = (j + 1/2)/M,   v_k at phi_k + pi/2.
// Ward and Heckbert 1992 have -tan(theta_j), for the pair n x n_2 in place of n_2 x n: docs/errata.md.
Eigen::Vector3d polarRotationalGradient(const HemisphereSamples& samples) {
  const GridShape shape = samples.shape;
  const auto rings = static_cast<double>(shape.rows);
  const auto columns = static_cast<double>(shape.columns);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < shape.columns; ++k) {
    double column_sum = 0.0;
    for (std::size_t j = 0; j < shape.rows; ++j) {
      const double middle = static_cast<double>(j) + 0.5;
      column_sum += std::sqrt(middle / (rings - middle)) * samples.radiance[j * shape.columns + k];
    }
    const double azimuth = 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / columns;
    sum += column_sum * Eigen::Vector2d(-std::sin(azimuth), std::cos(azimuth));
  }
  sum *= std::numbers::pi / (rings * columns);
  return {sum.x(), sum.y(), 0.0};
}

class WardHeckbert final : public Estimator {
 public:
  WardHeckbert(Stratification stratification, GridShape shape)
      : sums_(stratification, shape), walls_(strataWalls(Strata(stratification, shape))) {}

  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (const StrataWall& wall : walls_) {
      const double jump = samples.radiance[wall.second] - samples.radiance[wall.first];
      gradient += jump * nearerInverseDistance(samples, wall) * wall.vector;
    }
    IrradianceEstimate estimate;
    estimate.irradiance = sums_.irradiance(samples);
    estimate.rotational_gradient = samples.stratification == Stratification::kPolar ? polarRotationalGradient(samples)
                                                                                    : sums_.rotationalGradient(samples);
    estimate.gradient = Eigen::Vector3d(gradient.x(), gradient.y(), 0.0);
    return estimate;
  }

 private:
  StrataSums sums_;
  std::vector<StrataWall> walls_;
};

}  // namespace

std::unique_ptr<Estimator> makeWardHeckbert(Stratification stratification, GridShape shape) {
  return std::make_unique<WardHeckbert>(stratification, shape);
}

}  // namespace irradiff
