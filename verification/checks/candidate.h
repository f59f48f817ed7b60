#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "verification/checks/configuration.h"

#include <Eigen/Core>

#include <functional>
#include <string>

namespace irradiff {

enum class Quantity { kFormFactor, kGradient, kHessian };

/// "form factor", "gradient" or "hessian".
const char* nameOf(Quantity quantity);

/// What is put to the test: your own form factor, gradient or Hessian of a polygon. Leave out what you do not have.
///
///     Candidate mine{"my gradient"};
///     mine.gradient = [](const Configuration& c) { return myGradient(c.polygon.vertices, c.receiver.position,
///     c.receiver.normal); }; for (const Verdict& verdict : checkAll(mine, {})) std::cout << describe(verdict) << '\n';
///
/// Units: 1, 1/m, 1/m^2, derivatives with respect to the receiver's position. A candidate that throws or returns NaN
/// fails the check.
struct Candidate {
  std::string name;
  std::function<double(const Configuration&)> form_factor;
  std::function<Eigen::Vector3d(const Configuration&)> gradient;
  std::function<Eigen::Matrix3d(const Configuration&)> hessian;
  /// Bounds that the candidate claims for its absolute errors, of F and its derivatives; checked where given.
  std::function<DerivativeBounds(const Configuration&)> bounds;

  bool has(Quantity quantity) const;
  /// The quantity as a 1 x 1, 3 x 1 or 3 x 3 matrix. Requires has(quantity).
  Eigen::MatrixXd evaluate(Quantity quantity, const Configuration& configuration) const;
};

}  // namespace irradiff
