#pragma once

#include "derivatives/boundary/scene_evaluation_result.h"
#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/flatland/visible_part.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// What a flatland scene is made of as one receiver sees it, before anything is integrated.
struct FlatlandComposition {
  /// Without values: the flags, why derivatives do not exist, and the counts, in which all that is seen whole is
  /// integrated by its ends.
  SceneEvaluation<2> dark;
  std::vector<VisiblePart> parts;           ///< of segments that radiate, in the order of the scene
  std::vector<SegmentEvaluation> segments;  ///< each as if it were alone
};

/// What evaluateScene integrates. Throws InvalidScene as it does, but for sums and parts beyond the range of double.
FlatlandComposition composeScene(std::span<const Segment> segments, const FlatlandReceiver& receiver);

/// The segments that a part depends on and the receiver, in units of 2^exponent metres in which their coordinates are
/// below 1/2.
struct ScaledPart {
  std::vector<SegmentEnds<double>> ends;  ///< at the segments' indices; empty for those that do not matter
  Vector2<double> position;
  int exponent;
};

/// Throws InvalidScene, naming the part's segment, if numbers are so small beside others that products underflow.
ScaledPart scaledPart(const VisiblePart& part, std::span<const Segment> segments, const FlatlandReceiver& receiver);

// Irradiance of a flatland scene at the receiver with its gradient, Hessian and rotational gradient, occlusion included
// (docs/derivations/flatland.md, section 5). Units W/m, W/m^2, W/m^3 for radiance in W/(m rad). Error: at most
// `bounds`, norm-wise. What is seen whole contributes as evaluateSegment() has it, what is seen in part as the segment
// between its two boundary points. Where the receiver is at a visibility event, or on the line of a segment it sees
// end-on, and the radiances make it matter, the gradient and the Hessian do not exist.
//
// Throws InvalidScene as evaluateSegment() and visibleParts() do, and if a result exceeds the range of double. Requires
// validated arguments.
SceneEvaluation<2> evaluateScene(std::span<const Segment> segments, const FlatlandReceiver& receiver);

}  // namespace irradiff
