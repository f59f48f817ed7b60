#pragma once

#include "derivatives/estimators/estimator.h"

#include <memory>

namespace irradiff {

/// The derivatives of the projected solid angles of hemicube texels (Castaño, "Irradiance Caching - Part 1", 2011,
/// section "Translation Gradients", the first approach, which the article shows to fail).
///
/// Each texel is a small patch that stays where the texel was seen, parallel to its face of the hemicube and at the
/// depth of its hit; the article has all patches on the face itself, at depth 1, and differentiates once. Neither
/// occlusion nor the slope of a surface is known: right for unoccluded surfaces parallel to the faces through which
/// they are seen, and for no others. docs/derivations/sample_estimators.md, section "Hemicube texels".
///
/// Translational gradient and Hessian in space; rotational: StrataSums. A miss counts as infinitely far. Requires
/// kHemicube; throws as Strata.
std::unique_ptr<Estimator> makeHemicubeTexel(Stratification stratification, GridShape shape);

}  // namespace irradiff
