#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "verification/certified/ladder.h"
#include "verification/certified/rung.h"
#include "verification/enclosure/ball.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace irradiff {

/// A scene at one receiver with proven bounds.
template <int Dimension>
struct CertifiedScene {
  /// Values rounded to double; `bounds` are proven for the given doubles taken as exact, that rounding included.
  SceneEvaluation<Dimension> evaluation;
  /// What the values are the rounded midpoints of, if anything climbed above double.
  std::optional<IrradianceDerivatives<Ball, Dimension>> enclosure;
  /// How many sources were left on each rung: a polygon that is seen whole is one, all that is partly hidden another.
  std::array<std::size_t, kRungs.size()> sources{};
  /// The least tolerance that the result meets is not this one: the last rung did not suffice.
  bool misses_tolerance = false;

  /// The highest that holds a source; double where there is none.
  Rung rung() const;
};

/// What the sources add to a scene in which nothing shines, at the tolerance. Throws InvalidScene where the result is
/// beyond the range of double, and where even the last rung knows nothing.
template <int Dimension>
CertifiedScene<Dimension> climbTogether(const SceneEvaluation<Dimension>& dark,
                                        std::vector<LadderSource<Dimension>>& sources,
                                        const ReceiverIn<Dimension>& receiver, double tolerance);

}  // namespace irradiff
