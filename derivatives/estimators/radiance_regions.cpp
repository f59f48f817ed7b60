#include "derivatives/estimators/radiance_regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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

/// Of each ray, whether no other within two steps has its radiance. Two, since a boundary at a slant may part a region
/// one ray wide into rays that touch at corners only.
std::vector<bool> raysAlone(std::span<const double> radiance, std::span<const NeighbourPair> neighbours) {
  std::vector<std::vector<std::size_t>> around(radiance.size());
  for (const auto& [a, b] : neighbours) {
    around[a].push_back(b);
    around[b].push_back(a);
  }
  const auto isLike = [&](std::size_t i, std::size_t other) { return other != i && radiance[other] == radiance[i]; };
  std::vector<bool> is_alone(radiance.size());
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    is_alone[i] = std::none_of(around[i].begin(), around[i].end(), [&](std::size_t beside) {
      return isLike(i, beside) || std::any_of(around[beside].begin(), around[beside].end(),
                                              [&](std::size_t other) { return isLike(i, other); });
    });
  }
  return is_alone;
}

/// Differences between neighbours both of which are alone: within regions where radiance varies, but for a few.
std::vector<double> differencesAlone(std::span<const double> radiance, std::span<const NeighbourPair> neighbours) {
  const std::vector<bool> is_alone = raysAlone(radiance, neighbours);
  std::vector<double> differences;
  for (const auto& [a, b] : neighbours) {
    if (is_alone[a] && is_alone[b]) differences.push_back(std::abs(radiance[a] - radiance[b]));
  }
  return differences;
}

/// Above it a difference between neighbours stands out. Requires that there are differences.
double jumpThreshold(std::vector<double> differences) {
  constexpr double kStandsOut = 8.0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return kStandsOut * *middle;
}

}  // namespace

std::vector<double> regionRadiance(std::span<const double> radiance, std::span<const NeighbourPair> neighbours) {
  // Four rays around a cell are the least that tell radiance that varies from regions that one ray sees.
  constexpr std::size_t kFewestVarying = 4;
  std::vector<double> differences = differencesAlone(radiance, neighbours);
  if (differences.size() < kFewestVarying) return {radiance.begin(), radiance.end()};
  const double threshold = jumpThreshold(std::move(differences));

  std::vector<std::size_t> parent(radiance.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const NeighbourPair& pair : neighbours) {
    if (std::abs(radiance[pair[0]] - radiance[pair[1]]) <= threshold)
      parent[rootOf(parent, pair[1])] = rootOf(parent, pair[0]);
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
