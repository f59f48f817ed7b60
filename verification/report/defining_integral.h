#pragma once

#include "derivatives/boundary/vector.h"

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>
#include <cstddef>
#include <span>

namespace irradiff {

/// Integral over a planar polygon of a function of position, by 30 x 30 Gauss-Legendre points on each triangle of a
/// signed fan, so that any simple polygon will do. `integrand(point, weighted_normal)` returns what is summed;
/// `weighted_normal` is the area element of the point, towards the side from which the vertices run clockwise. For
/// integrands that are smooth on the scale of the polygon.
template <class Sum, class Integrand>
Sum sumOverArea(std::span<const Eigen::Vector3d> vertices, Sum sum, const Integrand& integrand) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const auto node = [](std::size_t k) {
    const std::size_t half = Rule::abscissa().size();
    const double sign = k < half ? -1.0 : 1.0;
    const std::size_t i = k < half ? k : k - half;
    return std::pair<double, double>{0.5 * (1.0 + sign * Rule::abscissa()[i]), 0.5 * Rule::weights()[i]};
  };
  const std::size_t count = 2 * Rule::abscissa().size();
  for (std::size_t t = 1; t + 1 < vertices.size(); ++t) {
    const Eigen::Vector3d a = vertices[t] - vertices[0];
    const Eigen::Vector3d b = vertices[t + 1] - vertices[0];
    const Eigen::Vector3d twice_area = a.cross(b);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [s, s_weight] = node(i);
      for (std::size_t j = 0; j < count; ++j) {
        const auto [u, u_weight] = node(j);
        // The unit square folded onto the triangle; its Jacobian is s.
        const Eigen::Vector3d point = vertices[0] + s * ((1.0 - u) * a + u * b);
        sum = sum + integrand(point, Eigen::Vector3d(twice_area * (s * s_weight * u_weight)));
      }
    }
  }
  return sum;
}

}  // namespace irradiff
