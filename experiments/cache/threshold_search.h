#pragma once

#include "experiments/cache/placement.h"
#include "experiments/cache/record_field.h"

#include <cstddef>

namespace irradiff {

struct TunedPlacement {
  MetricChoice choice;  ///< with the threshold found
  Placement placement;
  bool is_within = false;  ///< the count is within the tolerance: a metric may jump over it, or be unable to reach it
  std::size_t steps = 0;   ///< placements that were tried
};

inline constexpr double kRecordTolerance = 0.02;
inline constexpr std::size_t kMostSearchSteps = 40;

/// The threshold at which a metric needs `records` records to within `tolerance` of their number (the paper: 2 %), from
/// `choice.threshold` on: outwards until the number is bracketed, then by false position and bisection of the
/// logarithms. At most kMostSearchSteps placements are tried. The number does not fall with the threshold
/// everywhere, so that the closest one of all that were tried is the result if none is within.
///
/// Neighbours are clamped with the slope of the metric, `clampingSlope`, whatever the options say. Each record is made
/// once for each threshold.
///
/// A first threshold near the result saves placements: that of the metric's next number of records. Throws
/// std::invalid_argument naming the value and the rule for a first threshold that is not positive and finite, no
/// records, or a negative tolerance, and as `place`.
TunedPlacement tuneThreshold(const RecordField& field, const MetricChoice& choice, const PlacementOptions& options,
                             std::size_t records, double tolerance = kRecordTolerance);

}  // namespace irradiff
