#pragma once

#include "verification/certified/certified_result.h"

#include <string>

namespace irradiff {

/// Appends one element of "results" with proven bounds: what appendResult writes, with in "model"
///
///     "precision": "double|extended|ball", "rungs": {"double": N, "extended": N, "ball": N}, "meets_tolerance": bool
///
/// the highest rung, how many sources of light were left on each, and whether the last one sufficed. Where the doubles
/// cannot hold what the tolerance asks for, there is after "error_bound"
///
///     "decimal": {"irradiance": "3.14...", "gradient": ["..."], ..., "error_bound": {"irradiance": "1.2e-31", ...}}
///
/// with the same shapes, every number as a string of the digits that are known, and what they may be off at most.
void appendCertifiedResult(const CertifiedScene<3>& scene, double tolerance, std::string& text);
void appendCertifiedResult(const CertifiedScene<2>& scene, double tolerance, std::string& text);

}  // namespace irradiff
