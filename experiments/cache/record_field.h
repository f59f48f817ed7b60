#pragma once

#include "derivatives/error_metric/error_ellipse.h"
#include "experiments/cache/cache_record.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

/// How a record's region is chosen.
struct MetricChoice {
  std::string metric;            ///< one of RecordField::metrics
  double threshold = 0.0;        ///< unit: derivatives/error_metric/error_ellipse.h
  EllipseOptions ellipse;        ///< of the metrics that have ellipses
  double radiance_share = 0.01;  ///< added before a Hessian is taken (RecordEstimator): 0 or 0.01
  /// Irradiance and gradients with exact visibility as a control variate, where the field offers that.
  bool knows_geometry = false;
  double smallest_pixels = 1.0;  ///< limits of the half-axes, in widths of a pixel at the record
  double largest_pixels = std::numeric_limits<double>::infinity();
  /// The same for records that no light reaches, if less: nothing that such a record knows limits it.
  double black_pixels = std::numeric_limits<double>::infinity();
};

/// Makes the record of a receiver, by its number. May be called from several threads at once.
using RecordMaker = std::function<CacheRecord(std::size_t receiver)>;

/// Places where irradiance is wanted and may be cached, with the truth: pixels of a view, points of a plane or of the
/// walls of a flatland room. Every one can become a record, whose irradiance and derivatives are those of one gather at
/// this receiver: so records of a thousand placements cost each receiver at most one gather. Metrics differ in where
/// records are; those that extrapolate to second order, and a choice that knows the geometry, also in what records make
/// of the same rays. What a placement is charged is `rays_per_record` for each of its records.
struct RecordField {
  std::string name;
  std::size_t width = 0;   ///< of the image
  std::size_t height = 0;  ///< 1 in flatland
  /// Row-major numbers of pixels, the topmost row first, ascending: pixels that see an emitter or nothing have no
  /// receiver.
  std::vector<std::size_t> pixels;
  std::vector<Receiver> receivers;
  std::vector<std::size_t> faces;      ///< which face each is on; a record may serve any of them
  std::vector<double> reference;       ///< true irradiance; W/m^2
  std::vector<double> pixel_sizes;     ///< width of a pixel at the receiver, seen frontally; m
  double reference_error = 0.0;        ///< bound or estimate of the RMS error of `reference`; W/m^2
  bool offers_known_geometry = false;  ///< for MetricChoice::knows_geometry
  std::size_t rays_per_record = 0;     ///< 0 if derivatives are exact
  std::vector<std::string> metrics;    ///< in the order of tables
  /// Throws std::invalid_argument naming an unknown metric (with those that there are) or an option that it refuses.
  std::function<RecordMaker(const MetricChoice&)> records;
  /// Eq. (4) of [Schwarzhaupt et al. 2012] for a record at a receiver: the integral of |E(x + d) - E'(x + d)| over the
  /// record's region, E the truth and E' its extrapolation. W. From the ErrorProfile of the oracle, along the record's
  /// axes; in flatland over its interval. Requires finite half-axes. May be called from several threads at once; empty
  /// where the field does not offer it.
  std::function<double(std::size_t receiver, const CacheRecord& record)> true_error;
};

}  // namespace irradiff
