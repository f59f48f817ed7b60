#pragma once

#include "experiments/cache/cache_record.h"
#include "experiments/cache/irradiance_cache.h"
#include "experiments/cache/record_field.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace irradiff {

/// In which order receivers are asked for.
enum class PlacementOrder {
  kRows,     ///< pixels row by row
  kRefining  ///< pixels of a coarse grid first, then of grids twice as fine: spacing 16, 8, 4, 2, 1
};

/// Throws std::invalid_argument naming what was given and the names that there are: "rows", "refining".
PlacementOrder placementOrderOf(std::string_view name);

struct PlacementOptions {
  PlacementOrder order = PlacementOrder::kRefining;
  /// Interpolate all receivers anew when all records are there; otherwise a receiver has what the records said that
  /// were there when it was asked for.
  bool has_overture = true;
  /// Neighbour clamping, Krivanek et al. 2006: R_i <= R_j + slope |x_i - x_j| for all pairs, R the shorter half-axis.
  bool clamps_neighbours = false;
  double clamping_slope = 1.0;        ///< see `clampingSlope`
  std::size_t refinement_passes = 1;  ///< progressive refinement: radii 2^(p-1), ..., 2, 1 times in p passes
  double normal_deviation = kDefaultNormalDeviation;
  std::size_t most_records = 0;  ///< 0: as many as receivers. Placement stops there and says so
};

struct Placement {
  std::vector<CacheRecord> records;
  std::vector<std::size_t> record_receivers;  ///< the receiver of each
  std::vector<double> irradiance;             ///< of each receiver of the field
  bool reached_limit = false;                 ///< then receivers that no record serves have NaN
};

/// The slope of neighbour clamping that belongs to a choice. What obeys the triangle inequality is a distance to
/// surfaces, so it is the threshold for metrics whose radius is that share of a distance (split spheres), and 1 for
/// others.
double clampingSlope(const MetricChoice& choice);

/// Greedy: each receiver in its order is interpolated, and where no record serves it one is made there. Ends after at
/// most one record for each receiver. The same bits always. docs/derivations/irradiance_cache.md.
///
/// Throws std::invalid_argument naming the field and the rule for a field without receivers or with another number of
/// pixels, no passes or more than 32 of them, a slope that is not positive and finite, and as IrradianceCache::add.
Placement place(const RecordField& field, const RecordMaker& records, const PlacementOptions& options);

/// How many records `place` would make, without interpolating; nothing if it would be more than `most`.
std::optional<std::size_t> countRecords(const RecordField& field, const RecordMaker& records,
                                        const PlacementOptions& options, std::size_t most);

}  // namespace irradiff
