#pragma once

#include "derivatives/boundary/gauss_legendre.h"
#include "derivatives/boundary/irradiance.h"

#include <cmath>
#include <cstddef>

namespace irradiff {

/// Irradiance of a small source of radiance 1 and its derivatives, summed under the defining integral, with the sizes
/// that rounding errors are proportional to.
///   E = sum of (n.p)(A.p)/|p|^(d+1),  d the dimension, A = N dA (N dl in flatland)
/// and its first and second derivative with respect to the receiver, p = y - x.
template <int Dimension>
struct SmallSourceSums {
  using Vector = Eigen::Matrix<double, Dimension, 1>;
  using Matrix = Eigen::Matrix<double, Dimension, Dimension>;
  using Tangential = Eigen::Matrix<double, Dimension - 1, 1>;
  using TangentialMatrix = Eigen::Matrix<double, Dimension - 1, Dimension - 1>;

  /// A vector's components in the receiver's tangent plane, and a bound of their norm.
  struct InTangentPlane {
    Tangential components;
    double size;
  };

  double irradiance = 0.0;
  Vector gradient = Vector::Zero();
  Matrix hessian = Matrix::Zero();
  TangentialMatrix tangential_hessian = TangentialMatrix::Zero();
  Tangential tangential_irradiance = Tangential::Zero();  ///< of the vector irradiance: the rotational gradient's
  double irradiance_size = 0.0;
  double gradient_size = 0.0;
  double hessian_size = 0.0;
  double tangential_hessian_size = 0.0;
  double tangential_irradiance_size = 0.0;

  /// Adds the element `area` at p, given height = n.p >= 0 and offset = area.p without cancellation. Beyond rounding,
  /// offset is right to kSmallSourceError u times offset_slack and area to as much times area_size. `p_tangential` and
  /// `area_tangential` are p and area in the tangent plane, where both may be small.
  void add(const Vector& p, const InTangentPlane& p_tangential, double height, double offset, const Vector& area,
           const InTangentPlane& area_tangential, double area_size, double offset_slack, const Vector& normal) {
    constexpr double kPower = Dimension + 1;
    const double inverse_square = 1.0 / p.squaredNorm();
    const double inverse = std::sqrt(inverse_square);
    const double decay = Dimension == 3 ? inverse_square * inverse_square : inverse_square * inverse;
    const Vector slope = offset * normal + height * area;
    const Vector w = p * inverse_square;
    const double kernel = height * offset;
    irradiance += decay * kernel;
    gradient += decay * (kPower * kernel * w - slope);
    hessian += decay * (normal * area.transpose() + area * normal.transpose() -
                        kPower * (slope * w.transpose() + w * slope.transpose()) +
                        kPower * (kPower + 2.0) * kernel * w * w.transpose() -
                        kPower * kernel * inverse_square * Matrix::Identity());
    // Of the Hessian's terms those without the normal, each with the height as a factor.
    const Tangential w_tangential = p_tangential.components * inverse_square;
    const Tangential& a_tangential = area_tangential.components;
    tangential_irradiance += decay * offset * p_tangential.components;
    tangential_hessian +=
        decay * height *
        (kPower * (kPower + 2.0) * offset * w_tangential * w_tangential.transpose() -
         kPower * (a_tangential * w_tangential.transpose() + w_tangential * a_tangential.transpose()) -
         kPower * offset * inverse_square * TangentialMatrix::Identity());
    const double offset_size = std::abs(offset) + offset_slack;
    tangential_irradiance_size += decay * offset_size * p_tangential.size;
    tangential_hessian_size +=
        decay * height *
        (2.0 * kPower * area_tangential.size * inverse + kPower * (kPower + 3.0) * offset_size * inverse_square);
    const double kernel_size = height * offset_size;
    const double slope_size = offset_size + height * area_size;
    irradiance_size += decay * kernel_size;
    gradient_size += decay * (slope_size + kPower * kernel_size * inverse);
    hessian_size += decay * (2.0 * area_size + 2.0 * kPower * slope_size * inverse +
                             kPower * (kPower + 3.0) * kernel_size * inverse_square);
  }
};

/// Relative error of the terms at one node in units of u times their size (docs/derivations/error_bounds.md, section
/// 3).
inline constexpr double kSmallSourceError = 64.0;
/// The same for the tangential Hessian and the rotational gradient, with what turns vectors into the tangent plane.
inline constexpr double kSmallSourceTangentialError = 96.0;

/// Largest extent of a source, relative to its distance, that is integrated this way. Above it a sum over the boundary
/// loses less than a decimal digit and a half to cancellation.
inline constexpr double kSmallSourceExtent = 0.1;

/// A Gauss-Legendre rule for a source and the bound of its quadrature error relative to the sizes of SmallSourceSums.
struct SmallSourceRule {
  const GaussLegendreRule* rule;
  double truncation;
};

/// The smallest rule whose quadrature error is below the rounding errors, for a source within `extent` of a point that
/// is 1 away, extent <= kSmallSourceExtent. With n nodes a dimension it errs by at most 2^11 tau^(2n-2) times the
/// sizes, tau = extent/(1 - 2 extent): polynomial approximation on a Bernstein ellipse that stays within half the
/// distance to the kernel's complex poles (Trefethen, Approximation Theory and Approximation Practice, Theorem 8.2),
/// against weights that are positive; docs/derivations/error_bounds.md, section 3.2.
SmallSourceRule smallSourceRule(double extent);

}  // namespace irradiff
