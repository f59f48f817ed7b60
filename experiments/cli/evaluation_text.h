#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"

#include <string>
#include <string_view>

namespace irradiff {

/// JSON that a caller adds to a result, each starting with a comma unless it is empty.
struct FurtherFields {
  std::string after_bounds;  ///< after "error_bound"
  std::string in_model;      ///< at the end of "model"
};

/// Appends one element of "results" as JSON:
///
///     {"irradiance": E, "gradient": [3], "hessian": [[3],[3],[3]], "tangential_hessian": [[2],[2]],
///      "rotational_gradient": [3], "error_bound": {"irradiance":, "gradient":, "hessian":, "tangential_hessian":,
///      "rotational_gradient":},
///      "model": {"occlusion": false, "horizon": bool, "apparent_vertices": 0, "precision": "double",
///      "polygons": {"area_rule": n, "boundary": n, "partly_hidden": n, "black": n, "hidden": n, "edge_on": n,
///      "own_surface": n, "below_horizon": n}}}
///
/// `precision` is the model's: what was computed with. "polygons", in flatland "segments", are the SourceCounts, each
/// source once; they are missing where the evaluator treats all sources alike. In flatland the shapes are 2, 2 x 2, 1 x
/// 1 and 1. The tangential Hessian is in the frame of `tangentFrame(normal)`. A quantity without a value is null, its
/// bound too, and "reason" at the end says why. Numbers read back to the same double. Throws std::domain_error for a
/// number that is not finite.
void appendResult(const SceneEvaluation<3>& evaluation, std::string_view precision, const FurtherFields& further,
                  std::string& text);
void appendResult(const SceneEvaluation<2>& evaluation, std::string_view precision, const FurtherFields& further,
                  std::string& text);

/// The "model" of a result.
std::string modelText(const SceneEvaluation<3>& evaluation, std::string_view precision);
std::string modelText(const SceneEvaluation<2>& evaluation, std::string_view precision);

/// {"error": message} as JSON in ASCII.
std::string errorLine(std::string_view message);

}  // namespace irradiff
