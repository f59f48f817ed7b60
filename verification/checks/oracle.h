#pragma once

#include "derivatives/boundary/vector.h"
#include "verification/checks/candidate.h"
#include "verification/checks/configuration.h"
#include "verification/multiprecision/multiprecision.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// What an oracle knows about one input: values, and how far each may be off in the max norm (absolute); infinitely far
/// where it does not know the quantity at this input.
struct OracleValue {
  Multiprecision form_factor = 0;
  MultiprecisionVector gradient = MultiprecisionVector::Constant(0);                  ///< 1/m
  MultiprecisionMatrix hessian = MultiprecisionMatrix::Constant(0);                   ///< 1/m^2
  Matrix2<Multiprecision> tangential_hessian = Matrix2<Multiprecision>::Constant(0);  ///< 1/m^2
  MultiprecisionVector rotational_gradient = MultiprecisionVector::Constant(0);       ///< 1/rad
  double form_factor_uncertainty = 0.0;
  double gradient_uncertainty = 0.0;
  double hessian_uncertainty = 0.0;
  double tangential_hessian_uncertainty = 0.0;
  double rotational_gradient_uncertainty = 0.0;

  /// Sets the tangential Hessian and its uncertainty from the Hessian's.
  void projectHessian(const Configuration& configuration);
};

/// An independent source of truth.
struct Oracle {
  std::string name;
  std::string catches;  ///< which mistakes it can and cannot see
  std::vector<Quantity> knows;
  /// Nothing where the oracle does not apply to the input.
  std::function<std::optional<OracleValue>(const Configuration&)> evaluate;
};

/// Our templates at 200 digits: catches rounding, trusts the formula.
Oracle multiprecisionOracle();
/// Nested Ceres Jets on the form factor at 200 digits, over the position and over the normal: catches wrong derivative
/// algebra, trusts F.
Oracle jetOracle();
/// Jets on the gradient at 200 digits (first order): the Hessian alone, and what of it is in the tangent plane.
Oracle gradientJetOracle();
/// Central differences of the form factor at 200 digits with Ridders extrapolation: catches wrong derivative algebra,
/// trusts F.
Oracle differenceOracle();
/// Rigorous enclosures of the defining area integral and its kernel's derivatives, 18 digits: catches a wrong F. Slow;
/// polygons that are neither near nor cut close to a vertex.
Oracle enclosureOracle();

}  // namespace irradiff
