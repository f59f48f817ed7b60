#include "derivatives/estimators/radiance_regions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

bool isConstantByParts(std::span<const double> radiance) {
  constexpr std::size_t kRaysForValue = 4;
  std::vector<double> values(radiance.begin(), radiance.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values.size() * kRaysForValue <= radiance.size();
}

/// Above it a difference between neighbours stands out. Requires that not all differences are 0.
double jumpThreshold(std::span<const double> differences) {
  constexpr double kStandsOut = 8.0;
  std::vector<double> some;
  std::copy_if(differences.begin(), differences.end(), std::back_inserter(some), [](double d) { return d > 0.0; });
  const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
  std::nth_element(some.begin(), middle, some.end());
  return kStandsOut * *middle;
}

}  // namespace

std::vector<double> regionRadiance(std::span<const double> radiance, std::span<const NeighbourPair> neighbours) {
  const auto difference = [&](const NeighbourPair& pair) { return std::abs(radiance[pair[0]] - radiance[pair[1]]); };
  std::vector<double> differences;
  differences.reserve(neighbours.size());
  for (const NeighbourPair& pair : neighbours) differences.push_back(difference(pair));
  const bool varies = std::any_of(differences.begin(), differences.end(), [](double d) { return d > 0.0; });
  if (!varies || isConstantByParts(radiance)) return {radiance.begin(), radiance.end()};
  const double threshold = jumpThreshold(differences);

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
