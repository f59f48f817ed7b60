#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiff {

/// The wall between two neighbouring strata, and how irradiance responds to its motion.
///
/// A receiver that moves by dx in its tangent plane sees a wall at distance r sweep projected solid angle from `first`
/// to `second` at the rate -vector.dx / r. Where nothing but the walls moves,
///   dE/dx = sum over walls of (L_second - L_first) / r vector.
/// docs/derivations/sample_estimators.md, section "Strata walls". sr, in the frame (t, b).
struct StrataWall {
  // 24 bytes, for grids of 4096 x 4096: the last number of any grid is below 2^32, and nothing needs alignment.
  using Vector = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  Vector vector = Vector::Zero();
};

/// Every wall between two strata once. The horizon is no wall: the cosine vanishes there.
///
/// Polar walls are those of Ward and Heckbert 1992: a ring's share of a column has the direction of the column's middle
/// in place of the mean over the column, which is shorter by sin(h) / h, h half the column's angle. All others are
/// exact to rounding: the vector of concentric and hemicube walls is the integral over the wall of
/// (mu - (mu.X) X) dl, X the projection of the direction on the unit disk, mu the wall's normal in the disk.
std::vector<StrataWall> strataWalls(const Strata& strata);

/// 1/r of the nearer of the two hits beside a wall, with which the wall moves (Ward and Heckbert 1992). 1/m.
inline double nearerInverseDistance(const HemisphereSamples& samples, const StrataWall& wall) {
  return std::max(samples.inverse_distance[wall.first], samples.inverse_distance[wall.second]);
}

}  // namespace irradiff
