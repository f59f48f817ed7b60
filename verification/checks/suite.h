#pragma once

#include "verification/checks/input_families.h"
#include "verification/checks/oracle_check.h"
#include "verification/checks/verdict.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace irradiff {

/// What a suite of checks does. The defaults suit a double-precision formula for polygons above the horizon.
struct SuiteOptions {
  std::uint64_t seed = 1;
  std::size_t inputs = 100;    ///< for each family and check
  double tolerance = 2e-14;    ///< relative error allowed on well-conditioned inputs
  bool knows_horizon = false;  ///< include inputs that cross the horizon, and closure
  bool promises_extremes =
      false;  ///< hold the candidate to the promises of every input family; else to well-conditioned inputs
  bool slow_oracles =
      true;  ///< enclosures of the area integral and differences at 200 digits, on a tenth of the inputs
  /// data/reference; empty: without. Its extreme families only where those are promised.
  std::filesystem::path reference_folder = {};
};

/// What the production path promises on the family; F is left to its bound.
Allowance promiseOf(const InputFamily& family);

/// The same on a family of data/reference.
Allowance promiseOnReferences(const std::string& family);

/// Every check that applies to the candidate: oracles, closed forms, invariants, self-consistency, claimed bounds,
/// reference data. One verdict for each check, family and quantity.
std::vector<Verdict> checkAll(const Candidate& candidate, const SuiteOptions& options);

}  // namespace irradiff
