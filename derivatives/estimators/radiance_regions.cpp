#include "derivatives/estimators/radiance_regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

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

/// The neighbours of each ray that have another radiance, one list after the other.
class UnlikeNeighbours {
 public:
  UnlikeNeighbours(std::span<const double> radiance, const Neighbours& neighbours) : end_(radiance.size(), 0) {
    const auto forEachUnlike = [&](const NeighbourVisitor& visit) {
      neighbours([&](std::size_t a, std::size_t b) {
        if (radiance[a] != radiance[b]) visit(a, b);
      });
    };
    forEachUnlike([this](std::size_t a, std::size_t b) { ++end_[a], ++end_[b]; });
    std::exclusive_scan(end_.begin(), end_.end(), end_.begin(), std::size_t{0});
    numbers_.resize(2 * countOf(forEachUnlike));
    // Each entry moves from the start of its list to the end.
    forEachUnlike([this](std::size_t a, std::size_t b) {
      numbers_[end_[a]++] = static_cast<std::uint32_t>(b);
      numbers_[end_[b]++] = static_cast<std::uint32_t>(a);
    });
  }

  std::span<const std::uint32_t> of(std::size_t ray) const {
    const std::size_t start = ray == 0 ? 0 : end_[ray - 1];
    return std::span(numbers_).subspan(start, end_[ray] - start);
  }

 private:
  static std::size_t countOf(const Neighbours& neighbours) {
    std::size_t count = 0;
    neighbours([&count](std::size_t, std::size_t) { ++count; });
    return count;
  }

  std::vector<std::size_t> end_;
  std::vector<std::uint32_t> numbers_;
};

/// Of each ray, whether no other within two steps has its radiance. Two, since a boundary at a slant may part a region
/// one ray wide into rays that touch at corners only.
std::vector<bool> raysAlone(std::span<const double> radiance, const Neighbours& neighbours) {
  std::vector<bool> is_alone(radiance.size(), true);
  neighbours([&](std::size_t a, std::size_t b) {
    if (radiance[a] == radiance[b]) is_alone[a] = is_alone[b] = false;
  });
  const UnlikeNeighbours around(radiance, neighbours);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    if (!is_alone[i]) continue;
    const auto isLike = [&](std::size_t other) { return other != i && radiance[other] == radiance[i]; };
    is_alone[i] = std::ranges::none_of(
        around.of(i), [&](std::size_t beside) { return std::ranges::any_of(around.of(beside), isLike); });
  }
  return is_alone;
}

/// Differences between neighbours both of which are alone: within regions where radiance varies, but for a few.
std::vector<double> differencesAlone(std::span<const double> radiance, const Neighbours& neighbours) {
  const std::vector<bool> is_alone = raysAlone(radiance, neighbours);
  std::vector<double> differences;
  neighbours([&](std::size_t a, std::size_t b) {
    if (is_alone[a] && is_alone[b]) differences.push_back(std::abs(radiance[a] - radiance[b]));
  });
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

std::vector<double> regionRadiance(std::span<const double> radiance, const Neighbours& neighbours) {
  // Four rays around a cell are the least that tell radiance that varies from regions that one ray sees.
  constexpr std::size_t kFewestVarying = 4;
  std::vector<double> differences = differencesAlone(radiance, neighbours);
  if (differences.size() < kFewestVarying) return {radiance.begin(), radiance.end()};
  const double threshold = jumpThreshold(std::move(differences));

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
