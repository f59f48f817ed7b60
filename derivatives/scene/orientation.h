#pragma once

#include <Eigen/Core>

namespace irradiff {

/// Side of c of the line from a to b: +1 on the left, -1 on the right, 0 on the line; that is the sign of
/// (a - c) x (b - c). The sign is exact, after a filter with the error bound of Shewchuk, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates" (1997), section 4.2.
/// Requires finite coordinates whose products neither overflow nor underflow: magnitudes 0 or 2^-480 to 2^480.
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace irradiff
