#pragma once

#include "experiments/cache/record_field.h"
#include "experiments/curves/error_curves.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace irradiff {

inline constexpr std::array<double, 5> kRatioShares{0.05, 0.25, 0.5, 0.75, 0.95};

/// The regions that a metric gives all receivers of a field, beside those of the oracle: both with the threshold at
/// which they need as many records. Values are of each receiver, NaN where there is none.
struct RegionRatios {
  std::string metric;
  std::size_t records = 0;
  double threshold = 0.0;
  double oracle_threshold = 0.0;
  /// Geometric mean of the half-axes over the oracle's; 1 where both are infinite.
  std::vector<double> radii;
  /// True integrated error, Eq. (4), of the region over what the oracle's threshold allows.
  std::vector<double> errors;
  /// The same over what the metric's own threshold promises; empty for the split-sphere metrics, which promise none,
  /// and NaN in the dark, where relative errors are shares of next to nothing.
  std::vector<double> kept;
};

/// Quantiles of the values that are numbers, at kRatioShares, and the share of them above 1.
struct RatioQuantiles {
  std::size_t values = 0;
  std::array<double, kRatioShares.size()> quantiles{};  ///< NaN without values
  double share_above_1 = 0.0;
};
RatioQuantiles quantilesOf(const std::vector<double>& ratios);

/// What a threshold allows the error to be, integrated over a region with these half-axes; W. Relative errors are
/// shares of `irradiance`.
double allowedError(const RecordField& field, const MetricChoice& choice, double irradiance,
                    const Eigen::Vector2d& half_axes);

/// The diagonal of the box of all receivers: what is farther serves nobody. m.
double extentOf(const RecordField& field);

/// The geometric mean of the half-axes; in flatland half the length of the interval.
double radiusOf(const RecordField& field, const CacheRecord& record);

/// Of every metric that reached `asked_records` on the first field, at its threshold there; nothing if the oracle did
/// not reach it. `progress(done, all)` counts groups of receivers.
std::vector<RegionRatios> regionRatios(const RecordField& field, const ErrorCurves& curves, std::size_t asked_records,
                                       unsigned threads,
                                       const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace irradiff
