#pragma once

#include "experiments/cache/placement.h"
#include "experiments/cache/record_field.h"

#include <cstddef>

namespace irradiff {

struct TunedPlacement {
  MetricChoice choice;  ///< with the threshold found
  Placement placement;
  bool is_within = false;  ///< the count is within the tolerance: a metric may jump over it, or be unable to reach it
};

/// The threshold at which a metric needs `records` records to within `tolerance` of their number (the paper: 2 %), by
/// bisection of its logarithm from `choice.threshold` on, at most `kMostSearchSteps` placements; the closest count if
/// none is within.
inline constexpr double kRecordTolerance = 0.02;
inline constexpr std::size_t kMostSearchSteps = 40;
TunedPlacement tuneThreshold(const RecordField& field, const MetricChoice& choice, const PlacementOptions& options,
                             std::size_t records, double tolerance = kRecordTolerance);

}  // namespace irradiff
