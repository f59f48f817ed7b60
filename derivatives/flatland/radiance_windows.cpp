#include "derivatives/flatland/radiance_windows.h"

#include <cstddef>
#include <vector>

namespace irradiff {

FlatlandEstimate windowSums(std::span<const Eigen::Vector2d> borders, std::span<const FlatlandHit> hits) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < hits.size(); ++i) sum += hits[i].radiance * (borders[i] - borders[i + 1]);
  FlatlandEstimate estimate;
  estimate.irradiance = sum.x();
  estimate.rotational_gradient = sum.y();
  return estimate;
}

FlatlandEstimate strataSums(const FlatlandSamples& samples) {
  const std::vector<Eigen::Vector2d> borders = samples.strata.borders();
  return windowSums(borders, samples.hits);
}

}  // namespace irradiff
