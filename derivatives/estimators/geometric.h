#pragma once

#include "derivatives/estimators/estimator.h"

#include <Eigen/Core>

#include <memory>

namespace irradiff {

/// V |D| V^T of a symmetric matrix V D V^T: what the geometric Hessian adds up. Requires finite entries; error: 16 u of
/// the largest.
Eigen::Matrix2d absoluteValue(const Eigen::Matrix2d& matrix);

/// The geometric Hessian, which ignores radiance and changes of occlusion (Jarosz et al. 2012, carried to 3D; section 3
/// of Schwarzhaupt et al. 2012): how curved the irradiance could be if the radiance that arrives were distributed as
/// unfavourably as possible.
///
/// Only the tangential Hessian has a value: the sum over strata of |H|, the absolute value of the symmetric matrix H of
/// the stratum's patch (SurfacePatches), times the mean radiance E/pi. Without the absolute value a closed room would
/// give 0 whatever its shape. It bounds the radiometric Hessian of every radiance between 0 and E/pi from both sides.
/// There is no translational gradient. Rotational: StrataSums. Throws as Strata.
std::unique_ptr<Estimator> makeGeometric(Stratification stratification, GridShape shape);

}  // namespace irradiff
