#include "experiments/curves/cache_comparison.h"

#include "experiments/cache/threshold_search.h"
#include "experiments/curves/placement_pictures.h"
#include "experiments/curves/region_ratios.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace irradiff {

namespace {

/// Ends of the scale of radii: a share of all of them is beyond on each side.
constexpr double kShareBeyond = 0.02;

struct Run {
  TunedPlacement tuned;
  std::vector<double> radii;
  std::vector<double> errors;
};

Run runOf(const CacheVariant& variant) {
  Run run;
  if (variant.records) {
    run.tuned = tuneThreshold(*variant.field, variant.choice, variant.options, *variant.records);
  } else {
    run.tuned.choice = variant.choice;
    run.tuned.placement = place(*variant.field, variant.field->records(variant.choice), variant.options);
    run.tuned.is_within = true;
  }
  run.radii = allRadii(*variant.field, variant.field->records(run.tuned.choice));
  run.errors = relativeErrors(*variant.field, run.tuned.placement.irradiance);
  return run;
}

std::pair<double, double> radiusScale(const std::vector<Run>& runs) {
  std::vector<double> all;
  for (const Run& run : runs) {
    std::ranges::copy_if(run.radii, std::back_inserter(all), [](double radius) { return std::isfinite(radius); });
  }
  if (all.empty()) return {0.1, 1.0};
  std::ranges::sort(all);
  const auto beyond = static_cast<std::size_t>(kShareBeyond * static_cast<double>(all.size() - 1));
  const double low = all[beyond];
  const double high = all[all.size() - 1 - beyond];
  return {low, std::max(high, 1.01 * low)};
}

double errorScale(const std::vector<Run>& runs) {
  std::vector<double> all;
  for (const Run& run : runs) all.insert(all.end(), run.errors.begin(), run.errors.end());
  return amountLimit(all);
}

double correlationOf(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<std::pair<double, double>> logs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isfinite(a[i]) && std::isfinite(b[i])) logs.emplace_back(std::log(a[i]), std::log(b[i]));
  }
  double x = 0.0;
  double y = 0.0;
  for (const auto& [u, v] : logs) {
    x += u / static_cast<double>(logs.size());
    y += v / static_cast<double>(logs.size());
  }
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (const auto& [u, v] : logs) {
    xx += (u - x) * (u - x);
    yy += (v - y) * (v - y);
    xy += (u - x) * (v - y);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> densityOf(const RecordField& field, const Placement& placement) {
  std::vector<double> cells(kDensityCells * kDensityCells, 0.0);
  const std::size_t side = std::max(field.width, field.height);
  for (const std::size_t receiver : placement.record_receivers) {
    const std::size_t pixel = field.pixels[receiver];
    const std::size_t column = pixel % field.width * kDensityCells / side;
    const std::size_t row = pixel / field.width * kDensityCells / side;
    cells[row * kDensityCells + column] += 1.0 / static_cast<double>(placement.record_receivers.size());
  }
  return cells;
}

}  // namespace

std::vector<VariantResult> runVariants(const std::vector<CacheVariant>& variants, unsigned threads,
                                       const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<Run> runs(variants.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    tasks.emplace_back([&, i] { runs[i] = runOf(variants[i]); });
  }
  runTasks(tasks, threads, progress);
  const auto [shortest, longest] = radiusScale(runs);
  const double error_limit = errorScale(runs);
  std::vector<VariantResult> results;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const CacheVariant& variant = variants[i];
    TunedPlacement& tuned = runs[i].tuned;
    VariantResult result;
    result.label = variant.label;
    result.metric = variant.choice.metric;
    result.field = variant.field->name;
    result.threshold = tuned.choice.threshold;
    result.asked_records = variant.records.value_or(0);
    result.records = tuned.placement.records.size();
    result.rays = result.records * variant.field->rays_per_record;
    result.is_within = tuned.is_within;
    result.error = imageError(tuned.placement.irradiance, variant.field->reference);
    result.footprints = footprintPicture(*variant.field, tuned.placement, variant.choice.ellipse.largest_aspect);
    result.radii = radiusPicture(*variant.field, runs[i].radii, shortest, longest);
    result.errors = amountPicture(*variant.field, runs[i].errors, "error",
                                  "error of the interpolated irradiance over the mean", "1", error_limit);
    result.placement = std::move(tuned.placement);
    result.all_radii = std::move(runs[i].radii);
    results.push_back(std::move(result));
  }
  return results;
}

DistributionLikeness likeness(const RecordField& field, const std::vector<double>& radii, const Placement& placement,
                              const std::vector<double>& other_radii, const Placement& other_placement) {
  DistributionLikeness result;
  result.radius_correlation = correlationOf(radii, other_radii);
  const std::vector<double> density = densityOf(field, placement);
  const std::vector<double> other = densityOf(field, other_placement);
  const auto n = static_cast<double>(placement.records.size());
  const auto m = static_cast<double>(other_placement.records.size());
  for (std::size_t cell = 0; cell < density.size(); ++cell) {
    result.density_difference += 0.5 * std::abs(density[cell] - other[cell]);
    // Mean of |difference| of two independent counts of the same density, nearly normal.
    const double share = (n * density[cell] + m * other[cell]) / (n + m);
    result.chance_difference += 0.5 * std::sqrt(2.0 / std::numbers::pi * share * (1.0 / n + 1.0 / m));
  }
  return result;
}

}  // namespace irradiff
