#include "experiments/curves/error_curves.h"

#include "derivatives/error_metric/error_metric.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace irradiff {

namespace {

constexpr std::size_t kNumbersOfPoint = 7;
/// Of receivers, that may become records.
constexpr std::size_t kLargestShare = 4;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

template <class Member>
double medianOf(const std::vector<const CurvePoint*>& points, const Member& member) {
  std::vector<double> values;
  for (const CurvePoint* point : points) values.push_back(static_cast<double>(member(*point)));
  return median(std::move(values));
}

std::vector<const CurvePoint*> pointsAt(const ErrorCurves& curves, const std::string& metric, std::size_t records) {
  std::vector<const CurvePoint*> points;
  for (const CurvePoint& point : curves.points) {
    if (point.metric == metric && point.asked_records == records && point.is_within) points.push_back(&point);
  }
  return points;
}

std::vector<double> numbersOf(const std::vector<CurvePoint>& points) {
  std::vector<double> numbers;
  for (const CurvePoint& p : points) {
    numbers.insert(numbers.end(), {static_cast<double>(p.records), static_cast<double>(p.rays), p.threshold,
                                   p.is_within ? 1.0 : 0.0, p.error.rms, p.error.percentile_99, p.error.maximum});
  }
  return numbers;
}

std::vector<CurvePoint> pointsOf(const std::vector<double>& numbers) {
  std::vector<CurvePoint> points(numbers.size() / kNumbersOfPoint);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double* n = numbers.data() + i * kNumbersOfPoint;
    points[i].records = static_cast<std::size_t>(n[0]);
    points[i].rays = static_cast<std::size_t>(n[1]);
    points[i].threshold = n[2];
    points[i].is_within = n[3] == 1.0;
    points[i].error = {n[4], n[5], n[6]};
  }
  return points;
}

std::vector<CurvePoint> curveOf(const RecordField& field, const NamedChoice& named,
                                std::span<const std::size_t> records, const PlacementOptions& options) {
  std::vector<CurvePoint> points;
  MetricChoice start = named.choice(field);
  for (const std::size_t asked : records) {
    const TunedPlacement tuned = tuneThreshold(field, start, options, asked);
    CurvePoint point;
    point.records = tuned.placement.records.size();
    point.rays = point.records * field.rays_per_record;
    point.threshold = tuned.choice.threshold;
    point.is_within = tuned.is_within;
    point.error = imageError(tuned.placement.irradiance, field.reference);
    points.push_back(point);
    // Where a metric has reached its limits its threshold says nothing any more.
    if (tuned.is_within) start.threshold = tuned.choice.threshold;
  }
  return points;
}

}  // namespace

std::vector<std::string> ErrorCurves::metrics() const {
  std::vector<std::string> names;
  for (const CurvePoint& point : points) {
    if (std::ranges::find(names, point.metric) == names.end()) names.push_back(point.metric);
  }
  return names;
}

std::vector<CurveBand> ErrorCurves::bands(const std::string& metric) const {
  std::set<std::size_t> asked;
  for (const CurvePoint& point : points) asked.insert(point.asked_records);
  std::vector<CurveBand> bands;
  for (const std::size_t count : asked) {
    const std::vector<const CurvePoint*> at = pointsAt(*this, metric, count);
    if (at.empty()) continue;
    CurveBand band;
    band.asked_records = count;
    band.records = medianOf(at, [](const CurvePoint& p) { return p.records; });
    band.rays = medianOf(at, [](const CurvePoint& p) { return p.rays; });
    band.rms = medianOf(at, [](const CurvePoint& p) { return p.error.rms; });
    band.lowest_rms = band.highest_rms = at.front()->error.rms;
    for (const CurvePoint* point : at) {
      band.lowest_rms = std::min(band.lowest_rms, point->error.rms);
      band.highest_rms = std::max(band.highest_rms, point->error.rms);
    }
    bands.push_back(band);
  }
  return bands;
}

std::optional<double> ErrorCurves::slope(const std::string& metric) const {
  std::vector<std::pair<double, double>> logs;
  std::set<std::size_t> counts;
  for (const CurvePoint& point : points) {
    if (point.metric != metric || !point.is_within || !(point.error.rms > 0.0)) continue;
    logs.emplace_back(std::log(static_cast<double>(point.records)), std::log(point.error.rms));
    counts.insert(point.asked_records);
  }
  if (counts.size() < 2) return std::nullopt;
  double x = 0.0;
  double y = 0.0;
  for (const auto& [log_records, log_rms] : logs) {
    x += log_records / static_cast<double>(logs.size());
    y += log_rms / static_cast<double>(logs.size());
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (const auto& [log_records, log_rms] : logs) {
    covariance += (log_records - x) * (log_rms - y);
    variance += (log_records - x) * (log_records - x);
  }
  if (!(variance > 0.0)) return std::nullopt;
  return covariance / variance;
}

std::optional<ImageError> ErrorCurves::errorAt(const std::string& metric, std::size_t asked_records) const {
  const std::vector<const CurvePoint*> at = pointsAt(*this, metric, asked_records);
  if (at.empty()) return std::nullopt;
  return ImageError{medianOf(at, [](const CurvePoint& p) { return p.error.rms; }),
                    medianOf(at, [](const CurvePoint& p) { return p.error.percentile_99; }),
                    medianOf(at, [](const CurvePoint& p) { return p.error.maximum; })};
}

MetricChoice defaultChoice(const RecordField& field, const std::string& metric) {
  if (std::ranges::find(field.metrics, metric) == field.metrics.end()) {
    std::string names;
    for (const std::string& name : field.metrics) names += (names.empty() ? "" : ", ") + name;
    throw std::invalid_argument("unknown metric \"" + metric + "\", must be one of " + names);
  }
  MetricChoice choice;
  choice.metric = metric;
  // All that is known of the scene, against what the published metrics have: samples.
  choice.knows_geometry = metric == "second-order" && field.offers_known_geometry;
  const double pixel = median(field.pixel_sizes);
  const auto& descriptions = errorMetricDescriptions();
  const auto description = std::ranges::find(descriptions, metric, &ErrorMetricDescription::name);
  const bool has_ellipse = description == descriptions.end() || description->takes_hessian;
  if (!has_ellipse) {
    choice.threshold = 0.3;
  } else {
    // A mean error of 1 % over an interval of 20 pixels, over a circle with a radius of 10.
    choice.threshold = field.height == 1 ? 0.2 * pixel : 3.0 * pixel * pixel;
  }
  // 150 of 1800 pixels.
  choice.black_pixels = std::max(choice.smallest_pixels, static_cast<double>(field.width) / 12.0);
  if (metric == "bounded-split-sphere") choice.largest_pixels = choice.black_pixels;
  return choice;
}

std::vector<std::size_t> possibleCounts(const RecordField& field, std::span<const std::size_t> wanted) {
  const std::size_t most = std::max<std::size_t>(1, field.receivers.size() / kLargestShare);
  std::vector<std::size_t> counts;
  for (const std::size_t count : wanted) {
    if (count <= most) counts.push_back(count);
  }
  if (counts.empty()) counts.push_back(most);
  return counts;
}

ErrorCurves errorCurves(std::span<const RecordField> fields, std::span<const std::string> metrics,
                        std::span<const std::size_t> records, const PlacementOptions& options, unsigned threads,
                        const TileStore* finished, const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<NamedChoice> choices;
  for (const std::string& metric : metrics) {
    choices.push_back({metric, [metric](const RecordField& field) { return defaultChoice(field, metric); }});
  }
  return choiceCurves(fields, choices, records, options, threads, finished, progress);
}

ErrorCurves choiceCurves(std::span<const RecordField> fields, std::span<const NamedChoice> choices,
                         std::span<const std::size_t> records, const PlacementOptions& options, unsigned threads,
                         const TileStore* finished, const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::vector<CurvePoint>> curves(choices.size() * fields.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t m = 0; m < choices.size(); ++m) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const std::size_t tile = m * fields.size() + f;
      tasks.emplace_back([&, m, f, tile] {
        const auto numbers =
            finished == nullptr ? std::nullopt : finished->read(tile, records.size() * kNumbersOfPoint);
        curves[tile] = numbers ? pointsOf(*numbers) : curveOf(fields[f], choices[m], records, options);
        if (!numbers && finished != nullptr) finished->write(tile, numbersOf(curves[tile]));
        for (std::size_t i = 0; i < records.size(); ++i) {
          curves[tile][i].metric = choices[m].name;
          curves[tile][i].field = f;
          curves[tile][i].asked_records = records[i];
        }
      });
    }
  }
  runTasks(tasks, threads, progress);
  ErrorCurves all;
  if (!fields.empty()) all.scene = fields.front().name;
  for (const std::vector<CurvePoint>& points : curves)
    all.points.insert(all.points.end(), points.begin(), points.end());
  return all;
}

}  // namespace irradiff
