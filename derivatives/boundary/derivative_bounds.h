#pragma once

namespace irradiff {

/// Upper bounds of absolute errors, each in the max norm of its quantity (docs/derivations/error_bounds.md).
struct DerivativeBounds {
  double irradiance = 0.0;
  double gradient = 0.0;
  double hessian = 0.0;
  double tangential_hessian = 0.0;
  double rotational_gradient = 0.0;
};

}  // namespace irradiff
