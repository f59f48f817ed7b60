#pragma once

#include "derivatives/form_factor/prepared_polygon.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/ladder.h"

namespace irradiff {

/// A polygon of radiance 1 of which something is seen and which is not seen edge-on, whichever side it shows. Where
/// rounding hides which side that is, nothing is known at that step; at the last one, only that irradiance and
/// the rotational gradient are within their bounds: irradiance may be 0 there, with a kink.
CertifiedValue<3> polygonValue(const PreparedPolygon& prepared, const Receiver& receiver, const LadderStep& step);

/// Everything that is partly hidden.
CertifiedValue<3> viewValue(const SceneMesh& mesh, const SceneComposition& scene, const Receiver& receiver,
                            const LadderStep& step);

}  // namespace irradiff
