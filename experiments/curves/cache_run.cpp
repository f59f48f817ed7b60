#include "experiments/curves/cache_run.h"

#include "experiments/cache/threshold_search.h"
#include "experiments/curves/region_ratios.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace irradiff {

namespace {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

bool isUnlimited(const CacheRecord& record) { return std::isinf(record.half_axes.minCoeff()); }

}  // namespace

std::size_t CacheRun::served() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(placement.irradiance, [](double value) { return !std::isnan(value); }));
}

std::size_t CacheRun::unlimitedRecords() const {
  return static_cast<std::size_t>(std::ranges::count_if(placement.records, isUnlimited));
}

ImageError CacheRun::error() const {
  std::vector<double> irradiance;
  std::vector<double> reference;
  for (std::size_t i = 0; i < placement.irradiance.size(); ++i) {
    if (std::isnan(placement.irradiance[i])) continue;
    irradiance.push_back(placement.irradiance[i]);
    reference.push_back(field->reference[i]);
  }
  return imageError(irradiance, reference);
}

CacheRun runCache(const RecordField& field, const MetricChoice& choice, const PlacementOptions& options,
                  std::optional<std::size_t> records) {
  if (records && *records > field.receivers.size()) {
    throw std::invalid_argument(std::to_string(*records) + " records: must be at most the number of receivers, " +
                                std::to_string(field.receivers.size()));
  }
  CacheRun run;
  run.field = &field;
  run.options = options;
  run.asked_records = records;
  if (records) {
    TunedPlacement tuned = tuneThreshold(field, choice, options, *records);
    run.choice = tuned.choice;
    run.is_within = tuned.is_within;
    run.placement = std::move(tuned.placement);
  } else {
    run.choice = choice;
    run.placement = place(field, field.records(choice), options);
  }
  return run;
}

std::vector<std::string> runSentences(const CacheRun& run) {
  const std::size_t count = run.placement.records.size();
  const std::size_t receivers = run.field->receivers.size();
  const ImageError error = run.error();
  std::vector<std::string> sentences;
  sentences.push_back(std::to_string(count) + (count == 1 ? " record" : " records") + " of " + run.choice.metric +
                      " for " + std::to_string(receivers) + " receivers at threshold " + digits(run.choice.threshold) +
                      ", " + std::to_string(count * run.field->rays_per_record) + " rays.");
  sentences.push_back("Error over the mean irradiance: RMS " + digits(error.rms) + ", 99 % " +
                      digits(error.percentile_99) + ", largest " + digits(error.maximum) + "; of the reference " +
                      digits(run.field->reference_error /
                             [&] {
                               double mean = 0.0;
                               for (const double value : run.field->reference) mean += value;
                               return mean / static_cast<double>(receivers);
                             }()) +
                      '.');
  if (const std::size_t unlimited = run.unlimitedRecords(); unlimited > 0) {
    sentences.push_back(std::to_string(unlimited) + (unlimited == 1 ? " record has" : " records have") +
                        " no border: what the metric looks at is zero there, and one such record serves every receiver "
                        "whose normal is near its own.");
  }
  if (run.placement.reached_limit) {
    sentences.push_back("The limit of " + std::to_string(run.options.most_records) +
                        " records was reached: " + std::to_string(run.served()) + " of " + std::to_string(receivers) +
                        " receivers are served, the others have no value.");
  } else if (!run.is_within) {
    sentences.push_back("Asked for " + std::to_string(*run.asked_records) + " records: " + std::to_string(count) +
                        " is as near as " + run.choice.metric + " gets.");
  }
  return sentences;
}

}  // namespace irradiff
