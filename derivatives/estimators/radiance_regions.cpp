#include "derivatives/estimators/radiance_regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace irradiff {

namespace {

/// A forest of trees, one for each region; numbers of 32 bits, since there may be many rays.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  /// Halves the path to the root.
  std::uint32_t root(std::size_t i) {
    auto at = static_cast<std::uint32_t>(i);
    while (parent_[at] != at) {
      parent_[at] = parent_[parent_[at]];
      at = parent_[at];
    }
    return at;
  }

  void join(std::size_t a, std::size_t b) { parent_[root(b)] = root(a); }

 private:
  std::vector<std::uint32_t> parent_;
};

bool isConstantByParts(std::span<const double> radiance) {
  constexpr std::size_t kRaysForValue = 4;
  std::vector<double> values(radiance.begin(), radiance.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values.size() * kRaysForValue <= radiance.size();
}

/// Above it a difference between neighbours stands out; 0 if all are alike.
double jumpThreshold(std::span<const double> radiance, const Neighbours& neighbours) {
  constexpr double kStandsOut = 8.0;
  std::vector<double> differences;
  neighbours([&](std::size_t a, std::size_t b) {
    if (radiance[a] != radiance[b]) differences.push_back(std::abs(radiance[a] - radiance[b]));
  });
  if (differences.empty()) return 0.0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return kStandsOut * *middle;
}

}  // namespace

std::vector<double> regionRadiance(std::span<const double> radiance, const Neighbours& neighbours) {
  if (isConstantByParts(radiance)) return {radiance.begin(), radiance.end()};
  const double threshold = jumpThreshold(radiance, neighbours);
  UnionFind regions(radiance.size());
  neighbours([&](std::size_t a, std::size_t b) {
    if (std::abs(radiance[a] - radiance[b]) <= threshold) regions.join(a, b);
  });
  std::vector<double> mean(radiance.size(), 0.0);
  std::vector<std::uint32_t> count(radiance.size(), 0);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    // A running mean: a sum could go beyond the range of double.
    const std::uint32_t root = regions.root(i);
    mean[root] += (radiance[i] - mean[root]) / ++count[root];
  }
  for (std::size_t i = 0; i < radiance.size(); ++i) mean[i] = mean[regions.root(i)];
  return mean;
}

}  // namespace irradiff
