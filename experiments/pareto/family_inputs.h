#pragma once

#include "derivatives/form_factor/form_factor.h"
#include "verification/checks/configuration.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiff {

/// Inputs of one family with their values at 200 digits.
struct FamilyInputs {
  const InputFamily* family = nullptr;
  std::vector<Configuration> inputs;
  std::vector<OracleValue> truths;
  std::vector<bool> above_horizon;  ///< whether the whole polygon is
};

FamilyInputs familyInputs(const InputFamily& family, std::size_t count, std::uint64_t seed);

/// Of F, gradient, Hessian, and the largest of the three: max|value - truth|/max|truth|. Infinite where there is no
/// value, NaN where the truth is 0.
std::array<double, 4> relativeErrors(const FormFactor<long double>& value, const OracleValue& truth);
inline constexpr std::size_t kLargestError = 3;

}  // namespace irradiff
