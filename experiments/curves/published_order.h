#pragma once

#include "experiments/curves/error_curves.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

inline constexpr std::size_t kPublishedRecords = 1700;

/// A row of Figure 1 of [Schwarzhaupt et al. 2012], ours beside the paper's.
struct PublishedRow {
  std::string metric;
  ImageError error;                    ///< ours, relative to the mean; medians over the fields
  double ratio = 0.0;                  ///< rms over that of occlusion-hessian
  std::optional<double> lowest_ratio;  ///< over the fields, where there are several
  std::optional<double> highest_ratio;
  std::optional<double> published_rms;  ///< of the paper's image; nothing for a metric that it does not have
  std::optional<double> published_ratio;
  std::size_t rank = 0;  ///< among the published metrics, 1 the best; 0 for the others
  std::size_t published_rank = 0;
};

/// Figure 1: every metric at an asked count of records.
struct PublishedOrder {
  std::size_t records = 0;
  std::vector<PublishedRow> rows;      ///< in the order of tables; metrics that reached the count
  std::vector<std::string> unreached;  ///< metrics that did not
  bool agrees() const;                 ///< the published metrics have the paper's order, all of them
};

/// Requires that occlusion-hessian reached the count; nothing otherwise.
std::optional<PublishedOrder> publishedOrder(const ErrorCurves& curves, std::size_t asked_records);

}  // namespace irradiff
