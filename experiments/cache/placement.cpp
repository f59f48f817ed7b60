#include "experiments/cache/placement.h"

#include "derivatives/error_metric/error_metric.h"
#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace irradiff {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kCoarsestSpacing = 16;
constexpr std::size_t kMostPasses = 32;

void requirePlacement(const RecordField& field, const PlacementOptions& options) {
  if (field.receivers.empty() || field.receivers.size() != field.pixels.size()) {
    throw std::invalid_argument("field \"" + field.name + "\" has " + std::to_string(field.receivers.size()) +
                                " receivers and " + std::to_string(field.pixels.size()) +
                                " pixels, must have as many of each and at least one");
  }
  if (field.width == 0 || field.pixels.back() >= field.width * field.height) {
    throw std::invalid_argument("field \"" + field.name + "\": pixel " + std::to_string(field.pixels.back()) +
                                " is outside an image of " + std::to_string(field.width) + " x " +
                                std::to_string(field.height));
  }
  if (options.refinement_passes < 1 || options.refinement_passes > kMostPasses) {
    throw std::invalid_argument("progressive refinement in " + std::to_string(options.refinement_passes) +
                                " passes, must be 1 to " + std::to_string(kMostPasses));
  }
  if (!(options.clamping_slope > 0.0) || std::isinf(options.clamping_slope)) {
    throw std::invalid_argument("the slope of neighbour clamping is " + numberText(options.clamping_slope) +
                                ", must be positive and finite");
  }
}

/// The grid to which a pixel belongs first, the coarsest being 0.
std::size_t gridOf(std::size_t pixel, std::size_t width) {
  std::size_t grid = 0;
  for (std::size_t spacing = kCoarsestSpacing; pixel % width % spacing != 0 || pixel / width % spacing != 0;) {
    spacing /= 2;
    ++grid;
  }
  return grid;
}

/// Numbers of receivers in the order in which they are asked for.
std::vector<std::size_t> receiverOrder(const RecordField& field, PlacementOrder order) {
  std::vector<std::vector<std::size_t>> grids(1);
  for (std::size_t i = 0; i < field.receivers.size(); ++i) {
    const std::size_t grid = order == PlacementOrder::kRefining ? gridOf(field.pixels[i], field.width) : 0;
    if (grid >= grids.size()) grids.resize(grid + 1);
    grids[grid].push_back(i);
  }
  std::vector<std::size_t> result;
  for (const std::vector<std::size_t>& grid : grids) result.insert(result.end(), grid.begin(), grid.end());
  return result;
}

/// Records on the way: those of a pass have regions `enlargement` times their own.
class Placing {
 public:
  Placing(const RecordField& field, const RecordMaker& maker, const PlacementOptions& options, std::size_t most)
      : field_(field),
        maker_(maker),
        options_(options),
        most_(most),
        enlargement_(std::ldexp(1.0, static_cast<int>(options.refinement_passes) - 1)),
        cache_(options.normal_deviation),
        irradiance_(field.receivers.size(), kNaN) {}

  /// All passes. Ends at a receiver that would need one more than the most, if `ends_at_limit`; later receivers are
  /// interpolated all the same otherwise.
  void run(bool interpolates, bool ends_at_limit) {
    const std::vector<std::size_t> order = receiverOrder(field_, options_.order);
    for (std::size_t pass = 0; pass < options_.refinement_passes; ++pass) {
      if (pass > 0) halveRegions();
      const bool is_last = pass + 1 == options_.refinement_passes;
      std::size_t before = 0;
      do {
        before = records();
        for (const std::size_t receiver : order) {
          ask(receiver, interpolates && is_last && !options_.has_overture);
          if (reached_limit_ && ends_at_limit) return;
        }
        // A record that was clamped later may have left a receiver alone.
      } while (is_last && options_.has_overture && options_.clamps_neighbours && records() > before);
    }
    if (interpolates && options_.has_overture) {
      for (std::size_t i = 0; i < field_.receivers.size(); ++i) {
        irradiance_[i] = cache_.interpolate(field_.receivers[i]).value_or(kNaN);
      }
    }
  }

  std::size_t records() const { return record_receivers_.size(); }
  bool reachedLimit() const { return reached_limit_; }

  Placement result() && {
    return {cache_.records(), std::move(record_receivers_), std::move(irradiance_), reached_limit_};
  }

 private:
  void ask(std::size_t receiver, bool interpolates) {
    const Receiver& asking = field_.receivers[receiver];
    if (!cache_.serves(asking)) {
      if (records() == most_) {
        reached_limit_ = true;
        return;
      }
      CacheRecord record = maker_(receiver);
      record.half_axes *= enlargement_;
      cache_.add(record);
      record_receivers_.push_back(receiver);
      if (options_.clamps_neighbours) clampNeighbours();
    }
    if (interpolates) irradiance_[receiver] = cache_.interpolate(asking).value_or(kNaN);
  }

  // Of the newest record i: R_i <= R_j + slope |x_i - x_j| for all others j, then R_j <= R_i + slope |x_i - x_j|. With
  // that all pairs keep the triangle inequality, if they did before. By all records: with a slope below 1 they may be
  // far beyond the regions.
  void clampNeighbours() {
    const std::size_t newest = records() - 1;
    const auto radius = [this](std::size_t i) { return cache_.records()[i].half_axes.minCoeff(); };
    const auto rise = [this, newest](std::size_t j) {
      const Eigen::Vector3d step = cache_.records()[j].receiver.position - cache_.records()[newest].receiver.position;
      return options_.clamping_slope * enlargement_ * step.norm();
    };
    double most = radius(newest);
    for (std::size_t j = 0; j < newest; ++j) most = std::min(most, radius(j) + rise(j));
    cache_.shrink(newest, most);
    for (std::size_t j = 0; j < newest; ++j) cache_.shrink(j, radius(newest) + rise(j));
  }

  void halveRegions() {
    enlargement_ *= 0.5;
    IrradianceCache halved(options_.normal_deviation);
    for (CacheRecord record : cache_.records()) {
      record.half_axes *= 0.5;
      halved.add(record);
    }
    cache_ = std::move(halved);
  }

  const RecordField& field_;
  const RecordMaker& maker_;
  const PlacementOptions& options_;
  std::size_t most_;
  double enlargement_;
  IrradianceCache cache_;
  std::vector<std::size_t> record_receivers_;
  std::vector<double> irradiance_;
  bool reached_limit_ = false;
};

}  // namespace

PlacementOrder placementOrderOf(std::string_view name) {
  if (name == "rows") return PlacementOrder::kRows;
  if (name == "refining") return PlacementOrder::kRefining;
  throw std::invalid_argument("unknown order of placement \"" + std::string(name) + "\": must be rows or refining");
}

double clampingSlope(const MetricChoice& choice) {
  const auto descriptions = errorMetricDescriptions();
  const auto metric = std::ranges::find(descriptions, choice.metric, &ErrorMetricDescription::name);
  return metric != descriptions.end() && metric->takes_distance ? choice.threshold : 1.0;
}

Placement place(const RecordField& field, const RecordMaker& records, const PlacementOptions& options) {
  requirePlacement(field, options);
  const std::size_t most = options.most_records > 0 ? options.most_records : field.receivers.size();
  Placing placing(field, records, options, most);
  placing.run(true, false);
  return std::move(placing).result();
}

std::optional<std::size_t> countRecords(const RecordField& field, const RecordMaker& records,
                                        const PlacementOptions& options, std::size_t most) {
  requirePlacement(field, options);
  Placing placing(field, records, options, most);
  placing.run(false, true);
  return placing.reachedLimit() ? std::nullopt : std::optional(placing.records());
}

}  // namespace irradiff
