#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "verification/certified/certified_value.h"

namespace irradiff {

/// The values as doubles and the bounds of each quantity in its max norm. Irradiance is not negative: what rounding
/// leaves below 0 is set to 0, and its bound says so.
template <int Dimension>
void roundTo(const CertifiedValue<Dimension>& value, IrradianceDerivatives<double, Dimension>& derivatives,
             DerivativeBounds& bounds);

/// Whether every number is.
template <int Dimension>
bool isFinite(const IrradianceDerivatives<double, Dimension>& derivatives);

}  // namespace irradiff
