#include "derivatives/estimators/radiance_regions.h"

#include "derivatives/estimators/radiance_jump.h"

#include <cmath>
#include <numeric>

namespace irradiff {

namespace {

/// Root of a tree of a union-find forest, whose paths it halves.
std::size_t rootOf(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

}  // namespace

std::vector<double> regionRadiance(std::span<const double> radiance, std::span<const NeighbourPair> neighbours) {
  const auto difference = [&](const NeighbourPair& pair) { return std::abs(radiance[pair[0]] - radiance[pair[1]]); };
  std::vector<double> differences;
  differences.reserve(neighbours.size());
  for (const NeighbourPair& pair : neighbours) differences.push_back(difference(pair));
  const double threshold = jumpThreshold(std::move(differences));
  if (threshold == 0.0) return {radiance.begin(), radiance.end()};

  std::vector<std::size_t> parent(radiance.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const NeighbourPair& pair : neighbours) {
    if (difference(pair) <= threshold) parent[rootOf(parent, pair[1])] = rootOf(parent, pair[0]);
  }
  std::vector<double> sum(radiance.size(), 0.0);
  std::vector<double> count(radiance.size(), 0.0);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    sum[rootOf(parent, i)] += radiance[i];
    count[rootOf(parent, i)] += 1.0;
  }
  std::vector<double> result(radiance.size());
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    result[i] = sum[rootOf(parent, i)] / count[rootOf(parent, i)];
  }
  return result;
}

}  // namespace irradiff
