#include "derivatives/flatland/strata_walls.h"

#include "derivatives/flatland/radiance_windows.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace irradiff {

namespace {

/// Sums tangentialRate(i, nu, u) over the walls between strata i and i + 1.
template <class Rate>
FlatlandEstimate estimateFromWalls(const FlatlandSamples& samples, const Rate& tangentialRate) {
  const std::vector<Eigen::Vector2d> borders = samples.strata.borders();
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const double nearer = std::max(samples.hits[i].inverse_distance, samples.hits[i + 1].inverse_distance);
    sum += tangentialRate(i, borders[i + 1].y(), nearer);
  }
  FlatlandEstimate estimate = windowSums(borders, samples.hits);
  estimate.gradient = Eigen::Vector2d(sum, 0.0);
  return estimate;
}

}  // namespace

FlatlandEstimate estimateWardHeckbert(const FlatlandSamples& samples) {
  return estimateFromWalls(samples, [&samples](std::size_t i, double nu, double u) {
    return -(samples.hits[i + 1].radiance - samples.hits[i].radiance) * u * nu * nu;
  });
}

FlatlandEstimate estimateHemicube(const FlatlandSamples& samples) {
  return estimateFromWalls(samples, [&samples](std::size_t i, double nu, double u) {
    const auto weighted = [&samples](std::size_t k) {
      return samples.hits[k].radiance * samples.strata.direction(k).y();
    };
    return -(weighted(i + 1) - weighted(i)) * u * nu;
  });
}

}  // namespace irradiff
