#include "derivatives/error_metric/reprojection.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

/// Sine of the elevation at which the stratum on the horizon is looked for.
constexpr double kLowestElevation = 0x1p-20;

/// The largest float of its sign for what is larger.
float toFloat(double value) {
  constexpr double kLargest = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

/// Horizontal distance of what the stratum on the horizon has seen.
double horizontalDistance(const Strata& strata, const HemisphereSamples& samples, double angle) {
  const double horizontal = std::sqrt((1.0 - kLowestElevation) * (1.0 + kLowestElevation));
  const Eigen::Vector3d direction(horizontal * std::cos(angle), horizontal * std::sin(angle), kLowestElevation);
  const StratumPosition position = strata.position(direction);
  const std::size_t sample = position.row * samples.shape.columns + position.column;
  if (samples.inverse_distance[sample] == 0.0) return std::numeric_limits<double>::infinity();
  return std::hypot(samples.direction_t[sample], samples.direction_b[sample]) / samples.inverse_distance[sample];
}

}  // namespace

Reprojection::Reprojection(const HemisphereSamples& samples)
    : samples_(&samples), strata_(samples.stratification, samples.shape) {}

double Reprojection::irradiance(const Eigen::Vector2d& step) const {
  const double distance = std::hypot(step(0), step(1));
  EpipolarSlices slices;
  slices.fill(EpipolarGrid(strata_, std::atan2(step(1), step(0))), *samples_, distance > 0.0 ? distance : 1.0);
  return slices.irradiance(distance > 0.0 ? 1.0 : 0.0);
}

double Reprojection::freeDistance(double angle) const { return horizontalDistance(strata_, *samples_, angle); }

ReprojectedErrors::ReprojectedErrors(Stratification stratification, GridShape shape, std::size_t directions)
    : strata_(stratification, shape) {
  if (directions == 0 || directions % 2 != 0) {
    throw std::invalid_argument("the number of directions of reprojection is " + std::to_string(directions) +
                                ", must be even and positive");
  }
  for (std::size_t k = 0; k < directions / 2; ++k) {
    grids_.emplace_back(strata_, 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(directions));
  }
}

ReprojectedError ReprojectedErrors::predict(const HemisphereSamples& samples, std::span<const double> distances) const {
  const std::size_t directions = 2 * grids_.size();
  const std::size_t count = distances.size();
  ReprojectedError result;
  result.distances.assign(distances.begin(), distances.end());
  result.remainders.resize(directions * count);
  result.hidden.resize(directions);
  result.free_distances.resize(directions);

  const double length = distances.back();
  EpipolarSlices slices;
  for (std::size_t k = 0; k < grids_.size(); ++k) {
    slices.fill(grids_[k], samples, length);
    const double here = slices.irradiance(0.0);
    const double slope = slices.slope();
    for (const bool is_ahead : {true, false}) {
      const std::size_t direction = is_ahead ? k : k + grids_.size();
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(direction) / static_cast<double>(directions);
      const double free_distance = horizontalDistance(strata_, samples, angle);
      const double hidden = (is_ahead ? slices.hiddenAhead() : slices.hiddenBehind()) / length;
      result.hidden[direction] = toFloat(hidden);
      result.free_distances[direction] = free_distance;
      for (std::size_t m = 0; m < count && distances[m] < free_distance; ++m) {
        const double step = (is_ahead ? distances[m] : -distances[m]) / length;
        result.remainders[direction * count + m] = toFloat(slices.irradiance(step) - here - step * slope);
      }
    }
  }
  return result;
}

ErrorProfile ReprojectedError::profile(double hidden_radiance) const {
  ErrorProfile result{distances, remainders};
  for (float& error : result.errors) error = std::abs(error);
  addHidden(hidden_radiance, result);
  return result;
}

void ReprojectedError::addHidden(double hidden_radiance, ErrorProfile& profile) const {
  const std::size_t count = distances.size();
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    const double rate = static_cast<double>(hidden[k]);
    for (std::size_t m = 0; m < count && distances[m] < free_distances[k]; ++m) {
      float& error = profile.errors[k * count + m];
      const double measure = rate * distances[m];
      error = toFloat(static_cast<double>(error) + hidden_radiance * measure * (measure / kHiddenMeasure));
    }
  }
}

std::optional<double> ReprojectedError::remainder(const Eigen::Vector2d& step) const {
  const double distance = step.norm();
  if (distance == 0.0) return 0.0;
  if (distance > distances.back()) return std::nullopt;
  const std::size_t directions = free_distances.size();
  const double turn = std::atan2(step(1), step(0)) / (2.0 * std::numbers::pi);
  const double place = (turn < 0.0 ? turn + 1.0 : turn) * static_cast<double>(directions);
  const std::size_t before = static_cast<std::size_t>(place) % directions;
  const std::size_t after = (before + 1) % directions;
  const double share = place - std::floor(place);
  if (distance >= free_distances[share < 0.5 ? before : after]) return std::nullopt;

  const std::size_t m = static_cast<std::size_t>(
      std::distance(distances.begin(), std::lower_bound(distances.begin(), distances.end(), distance)));
  const auto along = [&](std::size_t direction) {
    const float* const values = remainders.data() + direction * distances.size();
    const double far = static_cast<double>(values[m]);
    if (m == 0) return far * (distance / distances[0]) * (distance / distances[0]);
    const double near = static_cast<double>(values[m - 1]);
    return near + (far - near) * (distance - distances[m - 1]) / (distances[m] - distances[m - 1]);
  };
  // Of a direction that is not free so far nothing is known.
  if (distance >= free_distances[before]) return along(after);
  if (distance >= free_distances[after]) return along(before);
  return (1.0 - share) * along(before) + share * along(after);
}

}  // namespace irradiff
