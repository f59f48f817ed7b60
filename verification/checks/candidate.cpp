#include "verification/checks/candidate.h"

namespace irradiff {

const char* nameOf(Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
      return "form factor";
    case Quantity::kGradient:
      return "gradient";
    case Quantity::kHessian:
      return "hessian";
    case Quantity::kTangentialHessian:
      return "tangential hessian";
    case Quantity::kRotationalGradient:
      return "rotational gradient";
    case Quantity::kIrradiance:
      return "irradiance";
  }
  return "";
}

double boundOf(const DerivativeBounds& bounds, Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return bounds.irradiance;
    case Quantity::kGradient:
      return bounds.gradient;
    case Quantity::kHessian:
      return bounds.hessian;
    case Quantity::kTangentialHessian:
      return bounds.tangential_hessian;
    case Quantity::kRotationalGradient:
      return bounds.rotational_gradient;
  }
  return 0.0;
}

bool Candidate::has(Quantity quantity) const {
  switch (quantity) {
    case Quantity::kFormFactor:
      return static_cast<bool>(form_factor);
    case Quantity::kGradient:
      return static_cast<bool>(gradient);
    case Quantity::kHessian:
      return static_cast<bool>(hessian);
    case Quantity::kTangentialHessian:
      return static_cast<bool>(tangential_hessian);
    case Quantity::kRotationalGradient:
      return static_cast<bool>(rotational_gradient);
    case Quantity::kIrradiance:
      return false;
  }
  return false;
}

Eigen::MatrixXd Candidate::evaluate(Quantity quantity, const Configuration& configuration) const {
  switch (quantity) {
    case Quantity::kFormFactor:
      return Eigen::MatrixXd::Constant(1, 1, form_factor(configuration));
    case Quantity::kGradient:
      return gradient(configuration);
    case Quantity::kHessian:
      return hessian(configuration);
    case Quantity::kTangentialHessian:
      return tangential_hessian(configuration);
    case Quantity::kRotationalGradient:
      return rotational_gradient(configuration);
    case Quantity::kIrradiance:
      break;
  }
  return {};
}

}  // namespace irradiff
