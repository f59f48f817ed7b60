#pragma once

#include "derivatives/samples/strata.h"

namespace irradiff {

/// Polar strata (stratification.h; Ward and Heckbert, "Irradiance Gradients", 1992, section 3: sin^2 of the polar angle
/// and the azimuth are uniform): the members of Strata of the same names.
Eigen::Vector3d polarDirection(const GridShape& shape, const StratumPosition& position);
StratumPosition polarPosition(const GridShape& shape, const Eigen::Vector3d& direction);
StratumPosition polarNearestPosition(const GridShape& shape, std::size_t row, std::size_t column,
                                     const Eigen::Vector3d& direction);

/// sr, of a stratum in row `row`. All strata have the projected solid angle pi / shape.size().
double polarSolidAngle(const GridShape& shape, std::size_t row);

}  // namespace irradiff
