#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <span>

namespace irradiff {

/// How each polygon is evaluated.
enum class PolygonMethod {
  kBoundary,  ///< evaluatePolygon: the production path
  kAppendix,  ///< evaluateAppendix: the form of the 2012 paper, for comparison
};

/// The sum over polygons that do not hide each other from the receiver.
///
/// Throws InvalidScene where one polygon hides part of another and at least one of the two radiates, and as
/// evaluatePolygon does. Two polygons hide each other if their interiors, above the horizon and as seen from the
/// receiver, overlap by more than the rounding of coordinates can move them: touching is allowed. Requires validated
/// arguments. O(n^2) in the number of triangles.
SceneEvaluation<3> evaluateUnoccluded(std::span<const Polygon> polygons, const Receiver& receiver,
                                      PolygonMethod method = PolygonMethod::kBoundary);

}  // namespace irradiff
