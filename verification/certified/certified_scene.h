#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/rung.h"
#include "verification/enclosure/ball.h"

#include <array>
#include <cstddef>
#include <optional>

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

/// Decides what is seen without rounding, as SceneEvaluator does, and lets each source climb until the bounds of the
/// sum meet `tolerance` (rung.h). A derivative that does not exist is not waited for. Throws InvalidScene as
/// SceneEvaluator::evaluate does, and std::invalid_argument for a tolerance outside [kSmallestTolerance, 1].
CertifiedScene<3> certifyScene(const SceneEvaluator& evaluator, const Receiver& receiver, double tolerance);

}  // namespace irradiff
