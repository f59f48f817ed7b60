#pragma once

#include "derivatives/estimators/estimator.h"

#include <memory>

namespace irradiff {

// Gradient and Hessian of the irradiance from a triangle mesh over the samples, each triangle with the radiance of its
// farthest vertex: section 4.1 and Eqs. (8) to (10) of [Schwarzhaupt et al. 2012]. Irradiance and rotational gradient
// are sums over strata. The mesh ends at the outermost samples, so the derivatives of constant radiance are not zero.
// docs/derivations/sample_estimators.md, "Sample meshes".
//
// Samples without a mesh (fewer than 2 rows or columns of concentric strata, fewer than 4 columns of polar ones) give
// no derivatives of position. Throws as Strata does.
std::unique_ptr<Estimator> makeTriangulated(Stratification stratification, GridShape shape);

// The same with the mesh continued to the horizon, so that constant radiance gives exactly zero: each outermost sample
// is joined to the point at infinity below it. docs/derivations/sample_estimators.md, "Sample meshes", has the reasons.
std::unique_ptr<Estimator> makeTriangulatedClosed(Stratification stratification, GridShape shape);

}  // namespace irradiff
