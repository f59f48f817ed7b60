#pragma once

#include "verification/checks/configuration.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

class KeyedRandom;

/// A family of seeded random inputs and what the production path promises on it, norm-wise, against values of at least
/// 40 digits.
struct InputFamily {
  std::string_view name;
  std::string_view description;
  /// Promised relative errors; 0 where only the reported bound is promised.
  double gradient_promise;
  double hessian_promise;
  double tangential_hessian_promise;
  double rotational_gradient_promise;  ///< relative to the larger of it and F
  Configuration (*draw)(KeyedRandom&);
};

/// Well-conditioned first.
const std::vector<InputFamily>& inputFamilies();

/// Throws std::invalid_argument if there is no family of that name.
const InputFamily& inputFamily(std::string_view name);

/// `count` inputs of the family. The input at an index depends on seed, family and index alone.
std::vector<Configuration> drawInputs(const InputFamily& family, std::size_t count, std::uint64_t seed);

/// `count` times the environment variable IRRADIFF_TEST_MULTIPLIER, which must be a positive number; 1 if it is not
/// set.
std::size_t lengthened(std::size_t count);

}  // namespace irradiff
