#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "verification/checks/configuration.h"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <string>

namespace irradiff {

/// What a check judges: the form factor of a polygon, or the irradiance of a scene, and derivatives.
enum class Quantity { kFormFactor, kGradient, kHessian, kTangentialHessian, kRotationalGradient, kIrradiance };

/// Those of one polygon.
inline constexpr std::array<Quantity, 5> kQuantities = {Quantity::kFormFactor, Quantity::kGradient, Quantity::kHessian,
                                                        Quantity::kTangentialHessian, Quantity::kRotationalGradient};

/// "form factor", "gradient", "hessian", "tangential hessian", "rotational gradient" or "irradiance".
const char* nameOf(Quantity quantity);

/// The bound of one quantity; that of irradiance for the form factor.
double boundOf(const DerivativeBounds& bounds, Quantity quantity);

/// What is put to the test: your own form factor of a polygon and derivatives of it. Leave out what you do not have.
///
///     Candidate mine{"my gradient"};
///     mine.gradient = [](const Configuration& c) {
///       return myGradient(c.polygon.vertices, c.receiver.position, c.receiver.normal);
///     };
///     std::cout << summarize(checkAll(mine, {}));
///
/// A whole program is docs/howto/examples/check_gradient.cpp.
/// Units: 1, 1/m, 1/m^2, derivatives with respect to the receiver's position; rotational gradient 1/rad. A candidate
/// that throws or returns NaN fails the check.
struct Candidate {
  std::string name;
  std::function<double(const Configuration&)> form_factor = {};
  std::function<Eigen::Vector3d(const Configuration&)> gradient = {};
  std::function<Eigen::Matrix3d(const Configuration&)> hessian = {};
  std::function<Eigen::Matrix2d(const Configuration&)> tangential_hessian = {};   ///< in tangentFrame(normal)
  std::function<Eigen::Vector3d(const Configuration&)> rotational_gradient = {};  ///< for n turning into n + omega x n
  /// The Hessian before it was made symmetric, where it was: its symmetry cannot be seen afterwards.
  std::function<Eigen::Matrix3d(const Configuration&)> hessian_before_symmetrisation = {};
  /// Bounds that the candidate claims for its absolute errors, of F and its derivatives; checked where given.
  std::function<DerivativeBounds(const Configuration&)> bounds = {};

  bool has(Quantity quantity) const;
  /// The quantity as a 1 x 1, 3 x 1, 3 x 3, 2 x 2 or 3 x 1 matrix. Requires has(quantity).
  Eigen::MatrixXd evaluate(Quantity quantity, const Configuration& configuration) const;
};

}  // namespace irradiff
