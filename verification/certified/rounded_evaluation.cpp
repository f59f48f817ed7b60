#include "verification/certified/rounded_evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {

namespace {

/// A number's bound; infinity where nothing is known, which may be NaN.
double boundOf(const RunningBound<double>& number) {
  return number.isFinite() ? number.error() : std::numeric_limits<double>::infinity();
}

template <class Rounded, class Matrix>
double roundMatrix(const Rounded& rounded, Matrix& values) {
  double bound = 0.0;
  for (Eigen::Index i = 0; i < rounded.rows(); ++i) {
    for (Eigen::Index j = 0; j < rounded.cols(); ++j) {
      values(i, j) = rounded(i, j).value() + 0.0;
      bound = std::max(bound, boundOf(rounded(i, j)));
    }
  }
  return bound;
}

}  // namespace

template <int Dimension>
void roundTo(const CertifiedValue<Dimension>& value, IrradianceDerivatives<double, Dimension>& derivatives,
             DerivativeBounds& bounds) {
  const auto& rounded = value.rounded;
  // Adding 0 leaves no -0 where a tiny number underflows.
  derivatives.irradiance.value = rounded.irradiance.value.value() + 0.0;
  bounds.irradiance = boundOf(rounded.irradiance.value);
  if (derivatives.irradiance.value < 0.0) {
    bounds.irradiance -= derivatives.irradiance.value;
    derivatives.irradiance.value = 0.0;
  }
  bounds.gradient = roundMatrix(rounded.gradient.value, derivatives.gradient.value);
  bounds.hessian = roundMatrix(rounded.hessian.value, derivatives.hessian.value);
  bounds.tangential_hessian = roundMatrix(rounded.tangential_hessian.value, derivatives.tangential_hessian.value);
  bounds.rotational_gradient = roundMatrix(rounded.rotational_gradient.value, derivatives.rotational_gradient.value);
}

template <int Dimension>
bool isFinite(const IrradianceDerivatives<double, Dimension>& d) {
  return std::isfinite(d.irradiance.value) && d.gradient.value.allFinite() && d.hessian.value.allFinite() &&
         d.tangential_hessian.value.allFinite() && d.rotational_gradient.value.allFinite();
}

template void roundTo(const CertifiedValue<2>&, IrradianceDerivatives<double, 2>&, DerivativeBounds&);
template bool isFinite(const IrradianceDerivatives<double, 2>&);
template void roundTo(const CertifiedValue<3>&, IrradianceDerivatives<double, 3>&, DerivativeBounds&);
template bool isFinite(const IrradianceDerivatives<double, 3>&);

}  // namespace irradiff
