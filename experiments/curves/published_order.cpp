#include "experiments/curves/published_order.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace irradiff {

namespace {

struct PublishedError {
  std::string_view metric;
  double rms;
};
/// Printed under the images of Figure 1, all at 1700 records +- 2 %.
constexpr std::array<PublishedError, 5> kPublishedErrors = {{{"split-sphere", 0.0901},
                                                             {"bounded-split-sphere", 0.0290},
                                                             {"radiometric-hessian", 0.0912},
                                                             {"geometric-hessian", 0.0105},
                                                             {"occlusion-hessian", 0.0071}}};
constexpr const char* kBest = "occlusion-hessian";

std::optional<double> publishedError(std::string_view metric) {
  const auto* error = std::ranges::find(kPublishedErrors, metric, &PublishedError::metric);
  return error == kPublishedErrors.end() ? std::nullopt : std::optional(error->rms);
}

/// The smallest and the largest ratio of two metrics' errors on the same field.
void addRange(PublishedRow& row, const ErrorCurves& curves, std::size_t asked_records) {
  std::vector<double> ratios;
  for (const CurvePoint& point : curves.points) {
    if (point.metric != row.metric || point.asked_records != asked_records || !point.is_within) continue;
    for (const CurvePoint& best : curves.points) {
      const bool is_beside = best.metric == kBest && best.field == point.field && best.asked_records == asked_records &&
                             best.is_within && best.error.rms > 0.0;
      if (is_beside) ratios.push_back(point.error.rms / best.error.rms);
    }
  }
  if (ratios.size() < 2) return;
  const auto [low, high] = std::ranges::minmax(ratios);
  row.lowest_ratio = low;
  row.highest_ratio = high;
}

template <class ErrorOf>
std::size_t rankOf(const std::vector<PublishedRow>& rows, const PublishedRow& row, ErrorOf error_of) {
  if (!row.published_rms) return 0;
  std::size_t rank = 1;
  for (const PublishedRow& other : rows) rank += other.published_rms && error_of(other) < error_of(row) ? 1 : 0;
  return rank;
}

}  // namespace

bool PublishedOrder::agrees() const {
  const auto published =
      std::ranges::count_if(rows, [](const PublishedRow& row) { return row.published_rms.has_value(); });
  return published == static_cast<std::ptrdiff_t>(kPublishedErrors.size()) &&
         std::ranges::all_of(rows, [](const PublishedRow& row) { return row.rank == row.published_rank; });
}

std::optional<PublishedOrder> publishedOrder(const ErrorCurves& curves, std::size_t asked_records) {
  const std::optional<ImageError> best = curves.errorAt(kBest, asked_records);
  if (!best || !(best->rms > 0.0)) return std::nullopt;
  PublishedOrder order;
  order.records = asked_records;
  for (const std::string& metric : curves.metrics()) {
    const std::optional<ImageError> error = curves.errorAt(metric, asked_records);
    if (!error) {
      order.unreached.push_back(metric);
      continue;
    }
    PublishedRow row;
    row.metric = metric;
    row.error = *error;
    row.ratio = error->rms / best->rms;
    row.published_rms = publishedError(metric);
    if (row.published_rms) row.published_ratio = *row.published_rms / *publishedError(kBest);
    addRange(row, curves, asked_records);
    order.rows.push_back(row);
  }
  for (PublishedRow& row : order.rows) {
    row.rank = rankOf(order.rows, row, [](const PublishedRow& r) { return r.error.rms; });
    row.published_rank = rankOf(order.rows, row, [](const PublishedRow& r) { return *r.published_rms; });
  }
  return order;
}

}  // namespace irradiff
