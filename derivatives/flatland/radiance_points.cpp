#include "derivatives/flatland/radiance_points.h"

namespace irradiff {

// With w = (tau, nu) in the frame (t, n) and u = 1/|r|:
//   G  = u (-nu^2, tau nu)
//   G' = u^2 { (J w) n^T + nu J - 3 nu (J w) w^T }
//      = u^2 ( 3 nu^2 tau        nu (3 nu^2 - 2)  )
//            ( nu (3 nu^2 - 2)   tau (1 - 3 nu^2) )
void setDerivatives(FlatlandEstimate& estimate, std::span<const RadiancePoint> points) {
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  for (const RadiancePoint& point : points) {
    const double tau = point.direction.x();
    const double nu = point.direction.y();
    const double u = point.inverse_distance;
    if (point.jump == 0.0 || u == 0.0 || !(nu > 0.0)) continue;
    const double nu_square = nu * nu;
    const double mixed = nu * (3.0 * nu_square - 2.0);
    Eigen::Matrix2d slope;
    slope << 3.0 * nu_square * tau, mixed, mixed, tau * (1.0 - 3.0 * nu_square);
    gradient += point.jump * u * Eigen::Vector2d(-nu_square, tau * nu);
    hessian -= point.jump * u * u * slope;
  }
  estimate.gradient = gradient;
  estimate.knows_normal_component = true;
  estimate.hessian = hessian;
  estimate.tangential_hessian = hessian(0, 0);
}

}  // namespace irradiff
