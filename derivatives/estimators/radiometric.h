#pragma once

#include "derivatives/estimators/estimator.h"

#include <memory>

namespace irradiff {

/// The radiometric Hessian, which ignores changes of occlusion (Jarosz et al. 2012, carried to 3D; compared with in
/// Figure 5 of Schwarzhaupt et al. 2012): the sum over strata of radiance times the Hessian of a patch that stays where
/// the stratum's ray hit (SurfacePatches). The gradient likewise.
///
/// Right where nothing is hidden; wrong without limit where an edge uncovers something, since each patch counts as
/// wholly visible. Translational derivatives in space; rotational: StrataSums. Throws as Strata.
std::unique_ptr<Estimator> makeRadiometric(Stratification stratification, GridShape shape);

}  // namespace irradiff
