#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/boundary/visibility_event.h"
#include "derivatives/scene/segment.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/rung.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace irradiff {

/// Whether the Hessian at a receiver says anything about the receiver's surroundings; the first that is so
/// (docs/inspect.md).
enum class HessianUse {
  kMissing,    ///< it does not exist
  kUndecided,  ///< the rounding of coordinates decides on which side of an event the receiver is
  kUncertain,  ///< its error bound is more than kRangeError of it
  kShort,      ///< the view changes where it is still asked: nearer than half the range that it promises
  kGood,
};

inline constexpr std::array<HessianUse, 5> kHessianUses = {
    HessianUse::kMissing, HessianUse::kUndecided, HessianUse::kUncertain, HessianUse::kShort, HessianUse::kGood};

/// "missing", "undecided", "uncertain", "short" or "good".
const char* nameOf(HessianUse use);

/// "vertex_on_edge", "three_edges", "edge_on" or "horizon".
const char* nameOf(EventKind kind);

/// Relative error of irradiance up to which a receiver's neighbours are extrapolated when the range of a Hessian is
/// asked for.
inline constexpr double kRangeError = 0.01;

/// The largest bound of the double path over its quantity's norm, as rung.h has both.
struct LoosestBound {
  double relative = 0.0;      ///< infinite where a quantity is 0 and its bound is not
  std::string_view quantity;  ///< whose it is; empty where there is no light
};

template <int Dimension>
LoosestBound loosestBound(const SceneEvaluation<Dimension>& evaluation);

/// What one receiver needs.
template <int Dimension>
struct PointInspection {
  ReceiverIn<Dimension> receiver;
  SceneEvaluation<Dimension> evaluation;
  LoosestBound loosest_bound;
  Rung rung = Rung::kDouble;  ///< the highest that the tolerance takes
  /// The nearest of all, and the nearest of those at which the Hessian jumps.
  std::optional<VisibilityEvent<Dimension>> event, jump;
  /// What is seen does change within this distance, where that was asked for and found (confirmedChange). Metres.
  std::optional<double> changes_within;
  HessianUse hessian = HessianUse::kGood;
  /// How far irradiance differs by at most kRangeError from its tangent, as the Hessian has it: sqrt(2 kRangeError
  /// E/|H|), |H| the largest eigenvalue. Metres; infinite where the Hessian is 0, and 0 where it is missing or there is
  /// no light.
  double promised_range = 0.0;
  /// In units of one square that is not hidden (evaluation_cost.h); not in flatland.
  std::optional<double> cost;
};

/// Throw InvalidScene as the evaluation does.
PointInspection<3> inspectPoint(const SceneEvaluator& evaluator, const Receiver& receiver, double tolerance);
PointInspection<2> inspectPoint(std::span<const Segment> segments, const FlatlandReceiver& receiver, double tolerance);

/// A distance within which what is seen of radiances does change: that of the first of the nearest events beyond which
/// it is another. Nothing if none of them shows. Takes as long as tens of evaluations.
std::optional<double> confirmedChange(const SceneEvaluator& evaluator, const Receiver& receiver);

}  // namespace irradiff
