#pragma once

#include "tests/mutants/formula_library.h"
#include "verification/checks/verdict.h"

#include <cstdint>
#include <string>
#include <vector>

namespace irradiff {

// Rotational gradients against differences of F (of irradiance, in flatland) over turned normals, with Ridders
// extrapolation and its own error estimate. Need no reference.

Verdict checkRotationalGradient(const FormulaLibrary& formulas, PolygonFormula formula,
                                const std::vector<Configuration>& inputs, const std::string& family, double tolerance);

/// Draws its own inputs.
Verdict checkFlatlandRotationalGradient(const FormulaLibrary& formulas, std::size_t inputs, std::uint64_t seed,
                                        double tolerance);

}  // namespace irradiff
