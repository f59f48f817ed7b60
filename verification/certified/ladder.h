#pragma once

#include "verification/certified/certified_value.h"
#include "verification/certified/rung.h"
#include "verification/enclosure/ball.h"

#include <functional>
#include <vector>

namespace irradiff {

/// A rung and, for balls, their bits.
struct LadderStep {
  Rung rung = Rung::kDouble;
  slong bits = 0;
};

/// The bits of the first balls that are tried for a tolerance, and of the last.
slong firstBits(double tolerance);
inline constexpr slong kMostBits = 1 << 14;

/// The step above, or the same where there is none.
LadderStep above(const LadderStep& step, double tolerance);

/// Which quantities are asked for: those that exist.
struct WantedQuantities {
  bool gradient = true;
  bool hessian = true;
  bool tangential_hessian = true;
};

/// Something that adds light, at any step of the ladder.
template <int Dimension>
struct LadderSource {
  double radiance = 1.0;
  /// Throws Undecided where the step's precision does not tell what is to be added up.
  std::function<CertifiedValue<Dimension>(const LadderStep&)> evaluate;
  LadderStep step;  ///< where it was left
  CertifiedValue<Dimension> value;
};

/// The sum of radiance times value of all sources, each on the lowest step with which the sum's bounds meet the
/// tolerance: first all in double, then those whose share of an error is too large a step higher, and so on. Where the
/// last step does not suffice, what that knows.
template <int Dimension>
CertifiedValue<Dimension> climb(std::vector<LadderSource<Dimension>>& sources, double tolerance,
                                const WantedQuantities& wanted);

/// Whether every quantity that is wanted meets the tolerance.
template <int Dimension>
bool meets(const CertifiedValue<Dimension>& value, double tolerance, const WantedQuantities& wanted);

/// Throws std::invalid_argument, naming the tolerance, unless it is in [kSmallestTolerance, 1].
void requireTolerance(double tolerance);

}  // namespace irradiff
