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
// of the larger of it and irradiance. A derivative may be 0 and has no relative error then: where all terms are seen to
// cancel to less than 2^-1024 T of their sizes, that is near enough.

}  // namespace irradiff
