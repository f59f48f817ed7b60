#pragma once

#include "derivatives/samples/strata.h"

namespace irradiff {

/// The texels of a hemicube (stratification.h; Cohen and Greenberg, "The Hemi-Cube", 1985): the members of Strata of
/// the same names. Requires a shape of 3 n x n, n even.
Eigen::Vector3d hemicubeDirection(const GridShape& shape, const StratumPosition& position);
StratumPosition hemicubePosition(const GridShape& shape, const Eigen::Vector3d& direction);
StratumPosition hemicubeNearestPosition(const GridShape& shape, std::size_t row, std::size_t column,
                                        const Eigen::Vector3d& direction);

/// sr, to a relative error of about ten units in the last place at every resolution: no difference of primitives at the
/// texel's corners, which would lose n^2 times as much.
double hemicubeProjectedSolidAngle(const GridShape& shape, std::size_t row, std::size_t column);
double hemicubeSolidAngle(const GridShape& shape, std::size_t row, std::size_t column);

}  // namespace irradiff
