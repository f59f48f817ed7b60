#pragma once

#include "derivatives/estimators/irradiance_estimate.h"
#include "derivatives/samples/hemisphere_samples.h"

#include <string>
#include <string_view>

namespace irradiff {

/// A line of `irradiff estimate` as JSON, in the shape of `irradiff evaluate` (evaluation_text.h):
///
///     {"results": [{"estimator": NAME, "irradiance": E, "gradient": [3], "gradient_normal_component": g,
///                   "hessian": [[3],[3],[3]], "tangential_hessian": [[2],[2]], "rotational_gradient": [3],
///                   "error_bound": {"irradiance": null, ...}, "reason": "..."}]}
///
/// Gradients and Hessian are in world coordinates, the frame of the samples' position; the tangential Hessian belongs
/// to the file's (tangent, bitangent). `gradient_normal_component` is normal.gradient, or null for an estimator that
/// knows the tangent plane only: the gradient is then the vector in that plane. What an estimator does not know is
/// null, and so is every bound; "reason" says why. Numbers read back to the same double. Throws std::domain_error for a
/// number that is not finite.
std::string estimateLine(std::string_view estimator, const SampleFrame& frame, const IrradianceEstimate& estimate);

}  // namespace irradiff
