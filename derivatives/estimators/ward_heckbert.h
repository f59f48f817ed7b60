#pragma once

#include "derivatives/estimators/estimator.h"

#include <memory>

namespace irradiff {

/// The gradient from the walls between strata (Ward and Heckbert, "Irradiance Gradients", 1992).
///
/// Translational, in the tangent plane: every wall between two strata moves with the nearer of the hits beside it and
/// uncovers the radiance of the one at the cost of the other (strata_walls.h). For polar strata this is the published
/// sum, and so is the rotational gradient. For concentric and hemicube strata it is the same construction with the
/// walls of those grids, and the rotational gradient is that of StrataSums. No Hessian.
///
/// Constant radiance gives a gradient of exactly 0. A 1 x 1 grid has no walls and gives 0 as well. Throws as Strata.
std::unique_ptr<Estimator> makeWardHeckbert(Stratification stratification, GridShape shape);

}  // namespace irradiff
