#pragma once

#include "experiments/cache/image_error.h"
#include "experiments/cache/threshold_search.h"

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
  std::size_t rays = 0;
  double threshold = 0.0;
  bool is_within = false;
  ImageError error;
};

/// Error against records of every metric on every field, which differ in their seeds alone.
struct ErrorCurves {
  std::string scene;
  std::vector<CurvePoint> points;

  /// d log rms/d log records of a metric by least squares over all fields; nothing with fewer than 2 counts.
  std::optional<double> slope(const std::string& metric) const;
};

/// The choice of a metric at which its search starts: limits and options as in Section 5 of [Schwarzhaupt et al. 2012].
MetricChoice defaultChoice(const RecordField& field, const std::string& metric);

ErrorCurves errorCurves(std::span<const RecordField> fields, std::span<const std::string> metrics,
                        std::span<const std::size_t> records, const PlacementOptions& options, unsigned threads,
                        const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
