#pragma once

#include "derivatives/form_factor/form_factor.h"
#include "verification/checks/configuration.h"
#include "verification/multiprecision/multiprecision.h"

#include <array>

namespace irradiff {

/// F, gradient and Hessian of a polygon above the horizon, of the given doubles taken as exact: the boundary form and
/// the appendix form at 200 digits, which must agree to 1e-40 of each quantity's largest component. So no variant is
/// measured by its own formula alone. Throws std::logic_error with the input where they do not agree.
FormFactor<Multiprecision> trueFormFactor(const Configuration& input);

/// The quantities of an atlas, in this order: F, gradient, Hessian.
inline constexpr std::size_t kAtlasQuantities = 3;
inline constexpr std::array<const char*, kAtlasQuantities> kAtlasQuantityNames = {"F", "gradient", "Hessian"};

/// max|d|/max|true| over the components of each quantity; infinite where a component is not finite.
using AtlasErrors = std::array<double, kAtlasQuantities>;
AtlasErrors relativeErrors(const FormFactor<long double>& actual, const FormFactor<Multiprecision>& expected);

}  // namespace irradiff
