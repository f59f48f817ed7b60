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
  bool clamps_neighbours = false;     ///< Krivanek et al. 2006: no region larger than a neighbour's plus the distance
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

/// Greedy: each receiver in its order is interpolated, and where no record serves it one is made there. Ends after at
/// most one record for each receiver. The same bits always. docs/derivations/irradiance_cache.md.
///
/// Throws std::invalid_argument naming the field and the rule for a field without receivers or with another number of
/// pixels, no passes or more than 32 of them, and as IrradianceCache::add.
Placement place(const RecordField& field, const RecordMaker& records, const PlacementOptions& options);

/// How many records `place` would make, without interpolating; nothing if it would be more than `most`.
std::optional<std::size_t> countRecords(const RecordField& field, const RecordMaker& records,
                                        const PlacementOptions& options, std::size_t most);

}  // namespace irradiff
