#include "derivatives/form_factor/boundary_form.h"
#include "verification/checks/input_families.h"
#include "verification/finite_difference/ridders.h"
#include "verification/multiprecision/multiprecision.h"
#include "verification/report/defining_integral.h"
#include "verification/report/errata.h"
#include "verification/report/residual_range.h"

#include <Eigen/Geometry>

namespace irradiff {
namespace {

/// The derivative of irradiance with respect to a rotation vector from its definition, g = integral of L (n x w) dw,
/// over a polygon of radiance 1.
Eigen::Vector3d rotationalGradientByDefinition(const Configuration& c) {
  return sumOverArea(std::span<const Eigen::Vector3d>(c.polygon.vertices), Eigen::Vector3d(Eigen::Vector3d::Zero()),
                     [&](const Eigen::Vector3d& point, const Eigen::Vector3d& area) -> Eigen::Vector3d {
                       const Eigen::Vector3d p = point - c.receiver.position;
                       return c.receiver.normal.cross(p) * (area.dot(p) / (p.squaredNorm() * p.squaredNorm()));
                     });
}

/// dE/dangle when the normal turns about a unit axis perpendicular to it, by differences at 200 digits.
double irradianceSlope(const Configuration& c, const Eigen::Vector3d& axis) {
  const std::vector<MultiprecisionVector> vertices = withoutRounding(c.polygon.vertices);
  const MultiprecisionVector position = withoutRounding(c.receiver.position);
  const MultiprecisionVector normal = withoutRounding(c.receiver.normal);
  const MultiprecisionVector turn = cross(withoutRounding(axis), normal);
  const auto irradiance = [&](const Multiprecision& angle) -> Multiprecision {
    const MultiprecisionVector turned =
        scaled(normal, Multiprecision(cos(angle))) + scaled(turn, Multiprecision(sin(angle)));
    return pi<Multiprecision>() * boundaryFormFactor<Multiprecision>(vertices, position, turned).value;
  };
  return riddersDerivative<Multiprecision>(irradiance, Multiprecision("1e-30"), Multiprecision("1e-140"))
      .value.convert_to<double>();
}

}  // namespace

Erratum measureRotationalPairing(std::size_t inputs, std::uint64_t seed) {
  ResidualRange pairing("rotational term with the rotation-vector gradient g", "differences over the normal", 1e-12);
  for (const Configuration& input : drawInputs(inputFamily("well-conditioned"), inputs, seed)) {
    const Eigen::Vector3d& n_i = input.receiver.normal;
    const Eigen::Vector3d g = rotationalGradientByDefinition(input);
    // About g itself the slope is largest.
    const Eigen::Vector3d axis = g.normalized();
    const double slope = irradianceSlope(input, axis);
    // To first order the turned normal is n = n_i + angle axis x n_i.
    const Eigen::Vector3d n_minus_n_i = axis.cross(n_i);
    pairing.add(std::abs(g.dot(n_minus_n_i.cross(n_i)) / slope - 1.0),
                std::abs(g.dot(n_i.cross(n_minus_n_i)) / slope - 1.0));
  }
  return {
      "Equation (15)",
      "which rotational gradient",
      "the rotational term is grad_n E.(n x n_i)",
      "n x n_i goes with the gradient written with -tan theta (Ward and Heckbert 1992); the derivative with respect "
      "to a rotation vector, g = integral of L (n x w) dw, goes with n_i x n",
      "Either pair is right by itself. Mixed, as measured here, the term has the wrong sign: a residual of 2.",
      {pairing.measurement()}};
}

}  // namespace irradiff
