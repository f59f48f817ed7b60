#pragma once

#include <array>

namespace irradiff {

/// What certified numbers are computed in, cheapest first.
enum class Rung {
  kDouble,    ///< double with a running error bound
  kExtended,  ///< double-double with a running error bound
  kBall,      ///< Arb balls, of as many bits as it takes
};

inline constexpr std::array<Rung, 3> kRungs = {Rung::kDouble, Rung::kExtended, Rung::kBall};

/// "double", "extended" or "ball".
const char* nameOf(Rung rung);

/// The tolerance of certified numbers unless the user gives another.
inline constexpr double kDefaultTolerance = 1e-12;
/// The smallest that may be asked for.
inline constexpr double kSmallestTolerance = 1e-60;

// A bound meets the tolerance T where it is at most T times the max norm of its quantity; for the rotational gradient
// of the larger of it and irradiance. A quantity that may be 0 has no relative error: where all terms cancel to less
// than T of their sizes, a bound of T^2 times those sizes is enough.

}  // namespace irradiff
