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
  }
  return "";
}

bool Candidate::has(Quantity quantity) const {
  switch (quantity) {
    case Quantity::kFormFactor:
      return static_cast<bool>(form_factor);
    case Quantity::kGradient:
      return static_cast<bool>(gradient);
    case Quantity::kHessian:
      return static_cast<bool>(hessian);
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
  }
  return {};
}

}  // namespace irradiff
