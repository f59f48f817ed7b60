#pragma once

#include "derivatives/flatland/half_circle.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace irradiff {

/// What a ray meets: a source, on the clockwise side of the ray, the counterclockwise side, or both.
struct RayStop {
  std::size_t source;
  bool covers_clockwise = false;
  bool covers_counterclockwise = false;
  /// The end that lies on the ray; nothing if it passes through the source, which then covers both sides. An end-on
  /// source covers neither and has two stops, one for each end.
  std::optional<std::size_t> end;
  std::size_t rank = 0;  ///< of its distance among those of the ray's stops
};

/// What is seen around one direction, from the receiver and from its neighbourhood.
struct SightRay {
  std::vector<RayStop> stops;  ///< by rank, up to the first that the ray passes through
  std::size_t ranks = 0;       ///< how many
  // The same radiance in all gaps between its points and beside them, from where the nearest is the most clockwise, and
  // from where it is the least.
  bool is_constant_nearest_first = false;
  bool is_constant_nearest_last = false;
  /// The radiance jumps at one fixed point, or not at all, from all of the neighbourhood.
  bool is_smooth = false;
  std::size_t point_rank = 0;  ///< where it jumps, if that is so
};

/// The sources on a ray from the receiver, up to the first that the ray passes through, and what they let see.
SightRay rayAlong(const HalfCircle& half_circle, const FlatlandDirection& direction);

}  // namespace irradiff
