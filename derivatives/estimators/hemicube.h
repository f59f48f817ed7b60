#pragma once

#include "derivatives/estimators/estimator.h"

#include <memory>

namespace irradiff {

/// The gradient from the walls between the texels of a hemicube (Castaño, "Irradiance Caching - Part 1", 2011, section
/// "Translation Gradients", the second approach).
///
/// Translational, in the tangent plane: the sum over texels of radiance times the cosine at the texel's middle times
/// the gradient of the texel's solid angle. That gradient is the sum over the texel's walls of the wall's normal in the
/// tangent plane times the wall's length, over the nearer of the depths beside it. Rotational: StrataSums.
/// docs/derivations/sample_estimators.md, section "Hemicube", tells what the article leaves open and what was decided.
///
/// As in the article each texel keeps its cosine while it moves. The limit at high resolution therefore lacks the
/// change of the cosine, and constant radiance does not give 0; `ward-heckbert` on the same samples has neither defect.
/// No Hessian. Requires kHemicube; throws as Strata.
std::unique_ptr<Estimator> makeHemicube(Stratification stratification, GridShape shape);

}  // namespace irradiff
