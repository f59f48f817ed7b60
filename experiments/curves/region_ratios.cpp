#include "experiments/curves/region_ratios.h"

#include "derivatives/error_metric/error_metric.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/figures/estimate_errors.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace irradiff {

namespace {

constexpr const char* kOracle = "oracle";
/// Receivers that one thread takes at a time.
constexpr std::size_t kChunk = 256;

bool promisesAnError(const std::string& metric) {
  const auto& descriptions = errorMetricDescriptions();
  const auto description = std::ranges::find(descriptions, metric, &ErrorMetricDescription::name);
  return description == descriptions.end() || description->takes_hessian;
}

double ratioOf(double value, double yardstick) {
  if (std::isinf(value) && std::isinf(yardstick)) return 1.0;
  return value / yardstick;
}

const CurvePoint* pointOf(const ErrorCurves& curves, const std::string& metric, std::size_t asked_records) {
  for (const CurvePoint& point : curves.points) {
    const bool is_it =
        point.metric == metric && point.field == 0 && point.asked_records == asked_records && point.is_within;
    if (is_it) return &point;
  }
  return nullptr;
}

MetricChoice choiceAt(const RecordField& field, const CurvePoint& point) {
  MetricChoice choice = defaultChoice(field, point.metric);
  choice.threshold = point.threshold;
  return choice;
}

RegionRatios emptyRatios(const CurvePoint& point, double oracle_threshold, std::size_t receivers) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  RegionRatios ratios;
  ratios.metric = point.metric;
  ratios.records = point.records;
  ratios.threshold = point.threshold;
  ratios.oracle_threshold = oracle_threshold;
  ratios.radii.assign(receivers, kNoNumber);
  ratios.errors.assign(receivers, kNoNumber);
  if (promisesAnError(point.metric)) ratios.kept.assign(receivers, kNoNumber);
  return ratios;
}

}  // namespace

RatioQuantiles quantilesOf(const std::vector<double>& ratios) {
  std::vector<double> sorted;
  for (const double ratio : ratios) {
    if (!std::isnan(ratio)) sorted.push_back(ratio);
  }
  std::ranges::sort(sorted);
  RatioQuantiles result;
  result.values = sorted.size();
  result.quantiles.fill(std::numeric_limits<double>::quiet_NaN());
  if (sorted.empty()) return result;
  for (std::size_t i = 0; i < kRatioShares.size(); ++i) result.quantiles[i] = percentile(sorted, kRatioShares[i]);
  const auto above = sorted.end() - std::ranges::upper_bound(sorted, 1.0);
  result.share_above_1 = static_cast<double>(above) / static_cast<double>(sorted.size());
  return result;
}

double allowedError(const RecordField& field, const MetricChoice& choice, double irradiance,
                    const Eigen::Vector2d& half_axes) {
  double allowed = choice.threshold;
  if (choice.ellipse.scale == ErrorScale::kRelative) allowed *= irradiance;
  if (choice.ellipse.measure == ErrorMeasure::kMean) {
    allowed *= field.height == 1 ? 2.0 * half_axes.x() : std::numbers::pi * half_axes.x() * half_axes.y();
  }
  return allowed;
}

double extentOf(const RecordField& field) {
  Eigen::Vector3d low = field.receivers.front().position;
  Eigen::Vector3d high = low;
  for (const Receiver& receiver : field.receivers) {
    low = low.cwiseMin(receiver.position);
    high = high.cwiseMax(receiver.position);
  }
  return (high - low).norm();
}

double radiusOf(const RecordField& field, const CacheRecord& record) {
  if (field.height == 1) return record.half_axes.x();
  return std::sqrt(record.half_axes.x()) * std::sqrt(record.half_axes.y());
}

std::vector<RegionRatios> regionRatios(const RecordField& field, const ErrorCurves& curves, std::size_t asked_records,
                                       unsigned threads,
                                       const std::function<void(std::size_t, std::size_t)>& progress) {
  const CurvePoint* oracle_point = pointOf(curves, kOracle, asked_records);
  if (oracle_point == nullptr || !field.true_error) return {};
  const MetricChoice oracle_choice = choiceAt(field, *oracle_point);
  const RecordMaker oracle = field.records(oracle_choice);
  const std::size_t receivers = field.receivers.size();
  std::vector<RegionRatios> all;
  std::vector<MetricChoice> choices;
  std::vector<RecordMaker> makers;
  for (const std::string& metric : curves.metrics()) {
    const CurvePoint* point = pointOf(curves, metric, asked_records);
    if (point == nullptr) continue;
    all.push_back(emptyRatios(*point, oracle_point->threshold, receivers));
    choices.push_back(choiceAt(field, *point));
    makers.push_back(field.records(choices.back()));
  }
  const double extent = extentOf(field);
  const double mean = std::accumulate(field.reference.begin(), field.reference.end(), 0.0) /
                      static_cast<double>(field.reference.size());
  const double least = kLeastIrradianceShare * mean;
  std::vector<std::function<void()>> tasks;
  for (std::size_t first = 0; first < receivers; first += kChunk) {
    tasks.emplace_back([&, first] {
      for (std::size_t i = first; i < std::min(first + kChunk, receivers); ++i) {
        const CacheRecord best = oracle(i);
        for (std::size_t m = 0; m < all.size(); ++m) {
          CacheRecord record = makers[m](i);
          all[m].radii[i] = ratioOf(radiusOf(field, record), radiusOf(field, best));
          // In the dark a metric's own promise is next to nothing; the oracle's is that of the least irradiance.
          record.half_axes = record.half_axes.cwiseMin(extent);
          const double error = field.true_error(i, record);
          const double shared = std::max(record.irradiance, least);
          all[m].errors[i] = error / allowedError(field, oracle_choice, shared, record.half_axes);
          const bool is_dark = !(record.irradiance >= least);
          if (all[m].kept.empty() || is_dark) continue;
          all[m].kept[i] = error / allowedError(field, choices[m], record.irradiance, record.half_axes);
        }
      }
    });
  }
  runTasks(tasks, threads, progress);
  return all;
}

}  // namespace irradiff
