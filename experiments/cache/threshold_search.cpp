#include "experiments/cache/threshold_search.h"

#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace irradiff {
namespace {

/// Logarithms of a threshold and of the records that it needs over those that are wanted.
struct Trial {
  double threshold;
  double excess;
  bool is_counted;  ///< else there are more records than `excess` says
};

// Thresholds are looked for from 1e-300 to 1e300.
const double kLongestSearch = std::log(1e300);
// Radii go with the fourth root of most thresholds, so numbers of records with the square root of one over it.
constexpr double kUsualSlope = 0.5;

/// What has been tried, and what to try next.
class Bracket {
 public:
  void add(const Trial& trial) {
    std::optional<Trial>& side = trial.excess > 0.0 ? too_many_ : too_few_;
    step_ = side && !isClosed() ? std::abs(trial.threshold - side->threshold) : 0.0;
    if (side && side->is_counted && trial.is_counted && side->excess != trial.excess) {
      slope_ = std::clamp((side->excess - trial.excess) / (trial.threshold - side->threshold), 0.1, 4.0);
    }
    side = trial;
  }

  /// Nothing if there is no threshold left.
  std::optional<double> next() {
    if (isClosed()) return inside();
    const Trial& last = too_many_ ? *too_many_ : *too_few_;
    // A little beyond the goal, and further each time.
    const double step = std::max(1.2 * std::abs(last.excess) / slope_, 2.0 * step_);
    const double result =
        std::clamp(last.threshold + std::copysign(step, last.excess), -kLongestSearch, kLongestSearch);
    return result == last.threshold ? std::nullopt : std::optional(result);
  }

 private:
  bool isClosed() const { return too_many_ && too_few_; }

  std::optional<double> inside() {
    ++inside_steps_;
    double share = too_many_->excess / (too_many_->excess - too_few_->excess);
    // Halving now and then ends what false position does not.
    if (!too_many_->is_counted || inside_steps_ % 3 == 0) share = 0.5;
    share = std::clamp(share, 0.05, 0.95);
    const double width = too_few_->threshold - too_many_->threshold;
    const double result = too_many_->threshold + share * width;
    return result == too_many_->threshold || result == too_few_->threshold ? std::nullopt : std::optional(result);
  }

  std::optional<Trial> too_many_;
  std::optional<Trial> too_few_;
  double slope_ = kUsualSlope;
  double step_ = 0.0;
  std::size_t inside_steps_ = 0;
};

/// Records by their receivers. Some metrics take long to choose a region.
using KeptRecords = std::unordered_map<std::size_t, CacheRecord>;

/// Makes a record unless it is among those kept, and keeps it.
RecordMaker keeping(RecordMaker maker, KeptRecords& kept) {
  return [maker = std::move(maker), &kept](std::size_t receiver) {
    const auto found = kept.find(receiver);
    return found != kept.end() ? found->second : kept.emplace(receiver, maker(receiver)).first->second;
  };
}

PlacementOptions optionsFor(const MetricChoice& choice, PlacementOptions options) {
  options.clamping_slope = clampingSlope(choice);
  return options;
}

void requireSearch(const MetricChoice& choice, std::size_t records, double tolerance) {
  const std::string text = "search for the threshold of " + choice.metric + ": ";
  if (!(choice.threshold > 0.0) || std::isinf(choice.threshold)) {
    throw std::invalid_argument(text + "the first threshold is " + numberText(choice.threshold) +
                                ", must be positive and finite");
  }
  if (records == 0) throw std::invalid_argument(text + "the number of records is 0, must be positive");
  if (!(tolerance >= 0.0)) {
    throw std::invalid_argument(text + "the tolerance is " + numberText(tolerance) + ", must be >= 0");
  }
}

}  // namespace

TunedPlacement tuneThreshold(const RecordField& field, const MetricChoice& choice, const PlacementOptions& options,
                             std::size_t records, double tolerance) {
  requireSearch(choice, records, tolerance);
  const auto wanted = static_cast<double>(records);
  // Beyond this a placement need not be finished to know that the threshold is too small.
  const std::size_t most = std::min(4 * records, field.receivers.size());

  TunedPlacement result{choice, {}, false, 0};
  KeptRecords closest_records;
  double closest = std::numeric_limits<double>::infinity();
  Bracket bracket;
  for (std::optional<double> log_threshold = std::log(choice.threshold);
       log_threshold && result.steps < kMostSearchSteps && !result.is_within; log_threshold = bracket.next()) {
    MetricChoice trial = choice;
    if (result.steps > 0) trial.threshold = std::exp(*log_threshold);
    ++result.steps;
    KeptRecords kept;
    const std::optional<std::size_t> count =
        countRecords(field, keeping(field.records(trial), kept), optionsFor(trial, options), most);
    const auto number = static_cast<double>(count.value_or(most + 1));
    const double distance = std::abs(number - wanted);
    // Until one is counted, thresholds have all been too small, each larger than those before.
    if (count ? distance < closest : std::isinf(closest)) {
      if (count) closest = distance;
      result.choice.threshold = trial.threshold;
      closest_records = std::move(kept);
    }
    result.is_within = count && distance <= tolerance * wanted;
    // As many records as there are receivers, and still too few.
    if (number < wanted && count == field.receivers.size()) break;
    bracket.add({*log_threshold, std::log(number / wanted), count.has_value()});
  }
  result.placement =
      place(field, keeping(field.records(result.choice), closest_records), optionsFor(result.choice, options));
  result.is_within = std::abs(static_cast<double>(result.placement.records.size()) - wanted) <= tolerance * wanted;
  return result;
}

}  // namespace irradiff
