#pragma once

#include "derivatives/samples/strata.h"

namespace irradiff {

/// Concentric strata (stratification.h; Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997): the
/// members of Strata of the same names.
///
/// With the coordinates (a, b) of the square and |a| >= |b| the point of the disk is at the signed radius a and the
/// angle pi b / (4 a) from the tangent; where |b| > |a| the axes change their parts.
Eigen::Vector3d concentricDirection(const GridShape& shape, const StratumPosition& position);
StratumPosition concentricPosition(const GridShape& shape, const Eigen::Vector3d& direction);
StratumPosition concentricNearestPosition(const GridShape& shape, std::size_t row, std::size_t column,
                                          const Eigen::Vector3d& direction);

/// sr. All strata have the projected solid angle pi / shape.size().
double concentricSolidAngle(const GridShape& shape, std::size_t row, std::size_t column);

}  // namespace irradiff
