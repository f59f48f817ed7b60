#pragma once

#include "verification/checks/candidate.h"
#include "verification/checks/library_candidates.h"

#include <stdexcept>
#include <string>

namespace irradiff {

/// The production candidate with every value of one quantity replaced: a twin that a check must reject.
/// `spoil(right value, configuration)` returns the wrong one.
template <class Spoil>
Candidate spoiled(Quantity quantity, const char* name, const Spoil& spoil) {
  const Candidate right = productionCandidate();
  Candidate twin = right;
  twin.name = name;
  const auto value = [right, quantity, spoil](const Configuration& c) -> Eigen::MatrixXd {
    return spoil(right.evaluate(quantity, c), c);
  };
  switch (quantity) {
    case Quantity::kFormFactor:
      twin.form_factor = [value](const Configuration& c) { return value(c)(0, 0); };
      break;
    case Quantity::kGradient:
      twin.gradient = [value](const Configuration& c) -> Eigen::Vector3d { return value(c); };
      break;
    case Quantity::kHessian:
      twin.hessian = [value](const Configuration& c) -> Eigen::Matrix3d { return value(c); };
      break;
    case Quantity::kTangentialHessian:
      twin.tangential_hessian = [value](const Configuration& c) -> Eigen::Matrix2d { return value(c); };
      break;
    case Quantity::kRotationalGradient:
      twin.rotational_gradient = [value](const Configuration& c) -> Eigen::Vector3d { return value(c); };
      break;
    case Quantity::kIrradiance:
      throw std::invalid_argument("a polygon's candidate has a form factor, no irradiance");
  }
  // What a twin spoils is what it had before it was made symmetric.
  twin.hessian_before_symmetrisation = nullptr;
  return twin;
}

inline Candidate multiplied(Quantity quantity, double factor) {
  return spoiled(
      quantity, "multiplied",
      [factor](const Eigen::MatrixXd& value, const Configuration&) -> Eigen::MatrixXd { return factor * value; });
}

}  // namespace irradiff
