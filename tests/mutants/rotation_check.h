#pragma once

#include "tests/mutants/formula_library.h"
#include "verification/checks/verdict.h"

#include <cstdint>
#include <vector>

namespace irradiff {

/// The rotational gradients of a library's production formulas, in 3D and in flatland, against differences of F (of
/// irradiance) over turned normals, with Ridders extrapolation and its own error estimate. Needs no reference.
std::vector<Verdict> checkRotationalGradient(const FormulaLibrary& formulas, std::size_t inputs, std::uint64_t seed,
                                             double tolerance);

}  // namespace irradiff
