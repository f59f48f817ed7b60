#include "experiments/cache_3d/second_order.h"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

namespace irradiff {
namespace {

// Of the quadrature over a region: as much as a polynomial of degree 4 with a kink or two needs.
constexpr int kAngles = 24;
constexpr int kRadii = 10;

/// Below this a pivot says that the steps do not tell the coefficients apart.
constexpr double kLeastPivot = 1e-6;

using Coefficients = Eigen::Matrix<double, 5, 1>;

}  // namespace

ErrorProfile errorsOf(const QuadraticIrradiance& extrapolation, const IrradianceAround& irradiance,
                      std::span<const double> distances, std::size_t directions) {
  ErrorProfile profile;
  profile.distances.assign(distances.begin(), distances.end());
  profile.errors.reserve(directions * distances.size());
  for (std::size_t k = 0; k < directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(directions);
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    for (const double distance : distances) {
      const Eigen::Vector2d step = distance * along;
      const std::optional<double> there = irradiance(step);
      profile.errors.push_back(there ? static_cast<float>(std::abs(*there - extrapolation.at(step))) : 0.0f);
    }
  }
  return profile;
}

QuadraticIrradiance nearestQuadratic(const QuadraticIrradiance& start, const IrradianceAround& irradiance,
                                     const ValidRegion& region) {
  // In units of the half-axes, along them: numbers of the order of 1.
  Eigen::Matrix<double, 5, 5> squares = Eigen::Matrix<double, 5, 5>::Zero();
  Coefficients products = Coefficients::Zero();
  double total_weight = 0.0;
  for (int i = 0; i < kRadii; ++i) {
    const double radius = (i + 0.5) / kRadii;
    const double weight = radius * (1.0 - radius);
    for (int k = 0; k < kAngles; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAngles;
      const double u = radius * std::cos(angle);
      const double v = radius * std::sin(angle);
      const std::optional<double> there =
          irradiance(region.axes * Eigen::Vector2d(u * region.half_axes(0), v * region.half_axes(1)));
      total_weight += weight;
      if (!there) continue;
      Coefficients powers;
      powers << u, v, 0.5 * u * u, u * v, 0.5 * v * v;
      squares += weight * powers * powers.transpose();
      products += weight * (*there - start.irradiance) * powers;
    }
  }
  const Eigen::LDLT<Eigen::Matrix<double, 5, 5>> solver(squares);
  if (!(solver.vectorD().minCoeff() > kLeastPivot * total_weight)) return start;
  const Coefficients c = solver.solve(products);
  const Eigen::Matrix2d to_frame = region.axes * region.half_axes.cwiseInverse().asDiagonal();
  Eigen::Matrix2d hessian;
  hessian << c(2), c(3), c(3), c(4);
  return {start.irradiance, to_frame * c.head<2>(), to_frame * hessian * to_frame.transpose()};
}

}  // namespace irradiff
