#pragma once

#include "experiments/cache/image_error.h"
#include "experiments/cache/threshold_search.h"
#include "experiments/figures/tile_store.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// One metric at one count of records, on one field.
struct CurvePoint {
  std::string metric;
  std::size_t field = 0;  ///< number of the field: of its seed
  std::size_t asked_records = 0;
  std::size_t records = 0;
  std::size_t rays = 0;  ///< of all records
  double threshold = 0.0;
  bool is_within = false;  ///< else the metric could not have this many records: no point of its curve
  ImageError error;
};

/// The points of a metric at one asked count, over all fields.
struct CurveBand {
  std::size_t asked_records = 0;
  double records = 0.0;  ///< median over the fields, as what follows
  double rays = 0.0;
  double rms = 0.0;
  double lowest_rms = 0.0;
  double highest_rms = 0.0;
};

/// Error against records of every metric on every field, which differ in their seeds alone.
struct ErrorCurves {
  std::string scene;
  std::vector<CurvePoint> points;  ///< metric after metric, its fields, their counts ascending

  /// Metrics in the order of the points.
  std::vector<std::string> metrics() const;

  /// Counts that were reached, ascending.
  std::vector<CurveBand> bands(const std::string& metric) const;

  /// d log rms/d log records of a metric by least squares over all fields; nothing with fewer than 2 counts.
  std::optional<double> slope(const std::string& metric) const;

  /// The median error of a metric at an asked count; nothing if it was not reached on any field.
  std::optional<ImageError> errorAt(const std::string& metric, std::size_t asked_records) const;
};

/// The choice of a metric at which its search starts: limits and options as in Section 5 of [Schwarzhaupt et al. 2012],
/// half-axes of at least 1 pixel and, for the bounded split sphere and in records without light, of at most 1/12 of the
/// image's width (150 of 1800); second-order records know the geometry where the field offers it.
/// The threshold is only a place to start from. Throws std::invalid_argument naming an unknown metric.
MetricChoice defaultChoice(const RecordField& field, const std::string& metric);

/// A curve that is not of a metric at its default choice alone: CurvePoint::metric is its name.
struct NamedChoice {
  std::string name;
  std::function<MetricChoice(const RecordField&)> choice;  ///< where the search starts
};

/// As many of `wanted` as the field has room for: with more than a quarter of the receivers being records nothing is
/// left to interpolate. At least one, however few receivers there are.
std::vector<std::size_t> possibleCounts(const RecordField& field, std::span<const std::size_t> wanted);

/// Tunes every metric to every count (ascending) on every field, several (metric, field) at a time; each search of a
/// metric begins where the one before ended. The same bits for any number of threads. What `finished` has is not
/// computed again; it may be null.
ErrorCurves errorCurves(std::span<const RecordField> fields, std::span<const std::string> metrics,
                        std::span<const std::size_t> records, const PlacementOptions& options, unsigned threads,
                        const TileStore* finished, const std::function<void(std::size_t, std::size_t)>& progress = {});

/// The same for choices of one's own.
ErrorCurves choiceCurves(std::span<const RecordField> fields, std::span<const NamedChoice> choices,
                         std::span<const std::size_t> records, const PlacementOptions& options, unsigned threads,
                         const TileStore* finished, const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
