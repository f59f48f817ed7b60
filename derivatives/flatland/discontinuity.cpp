#include "derivatives/flatland/discontinuity.h"

#include "derivatives/flatland/hit_line.h"
#include "derivatives/flatland/radiance_points.h"
#include "derivatives/flatland/radiance_windows.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

using Eigen::Vector2d;

/// Whether the hits of rays i and i + 1 are on one surface: 1/r of one is where the line through the hits of the other
/// and that one's other neighbour has it, to within half of their difference.
bool onOneSurface(std::span<const Vector2d> directions, std::span<const FlatlandHit> hits, std::size_t i) {
  const auto seen = [&](std::size_t k) { return SeenHit{directions[k], hits[k].inverse_distance}; };
  const double allowed = std::abs(hits[i + 1].inverse_distance - hits[i].inverse_distance) / 2.0;
  const auto continues = [&](std::size_t before, std::size_t here, std::size_t next) {
    const double expected = lineWithSlope(seen(here), slopeAtFirst(seen(here), seen(before))).dot(directions[next]);
    return std::abs(hits[next].inverse_distance - expected) <= allowed;
  };
  return (i > 0 && continues(i - 1, i, i + 1)) || (i + 2 < hits.size() && continues(i + 2, i + 1, i));
}

/// From each ray to the next; `between` are the directions in their middles.
std::vector<RadiancePoint> radianceBoundary(std::span<const Vector2d> directions, std::span<const Vector2d> between,
                                            std::span<const FlatlandHit> hits) {
  std::vector<RadiancePoint> points;
  points.reserve(between.size());
  for (std::size_t i = 0; i < between.size(); ++i) {
    const double a = hits[i].inverse_distance;
    const double b = hits[i + 1].inverse_distance;
    const double jump = hits[i + 1].radiance - hits[i].radiance;
    if (jump == 0.0) continue;
    points.push_back({between[i], onOneSurface(directions, hits, i) ? a / 2.0 + b / 2.0 : std::max(a, b), jump});
  }
  return points;
}

Vector2d directionAt(double angle) { return {std::cos(angle), std::sin(angle)}; }

struct CastRay {
  double angle;  ///< counterclockwise from t
  FlatlandHit hit;
};

/// Two neighbouring rays by their numbers, which see different radiance.
struct Gap {
  double uncertainty;  ///< difference of radiance times angle; W/m
  std::size_t start, stop;
  bool operator<(const Gap& other) const {
    return std::pair(uncertainty, start) < std::pair(other.uncertainty, other.start);
  }
};

/// Rays at equal angles, and more of them where radiance differs between neighbours.
class JumpSearch {
 public:
  JumpSearch(const FlatlandRayQuery& query, std::size_t first_rays) : query_(query) {
    const double width = std::numbers::pi / static_cast<double>(first_rays);
    for (std::size_t i = 0; i < first_rays; ++i) cast((static_cast<double>(i) + 0.5) * width);
    for (std::size_t i = 0; i + 1 < rays_.size(); ++i) addGap(i, i + 1);
  }

  /// Casts rays up to `budget` in all.
  void narrow(std::size_t budget) {
    while (rays_.size() < budget && !gaps_.empty()) {
      const Gap gap = gaps_.top();
      gaps_.pop();
      const double start = rays_[gap.start].angle;
      const double stop = rays_[gap.stop].angle;
      const double middle = start + (stop - start) / 2.0;
      if (!(start < middle && middle < stop)) continue;
      cast(middle);
      const std::size_t parting = rays_.size() - 1;
      addGap(gap.start, parting);
      addGap(parting, gap.stop);
    }
  }

  std::vector<CastRay> inOrder() const {
    std::vector<CastRay> rays = rays_;
    std::sort(rays.begin(), rays.end(), [](const CastRay& a, const CastRay& b) { return a.angle < b.angle; });
    return rays;
  }

 private:
  void cast(double angle) { rays_.push_back({angle, query_(directionAt(angle))}); }

  void addGap(std::size_t start, std::size_t stop) {
    const double difference = std::abs(rays_[stop].hit.radiance - rays_[start].hit.radiance);
    if (difference > 0.0) gaps_.push({difference * (rays_[stop].angle - rays_[start].angle), start, stop});
  }

  const FlatlandRayQuery& query_;
  std::vector<CastRay> rays_;
  std::priority_queue<Gap> gaps_;
};

}  // namespace

FlatlandDiscontinuityEstimate estimateFromFlatlandDiscontinuities(const FlatlandRayQuery& query, std::size_t budget) {
  if (budget < kFewestFlatlandDiscontinuityRays) {
    throw std::invalid_argument("flatland discontinuity estimator: a budget of " + std::to_string(budget) +
                                " rays, must be at least " + std::to_string(kFewestFlatlandDiscontinuityRays));
  }
  JumpSearch search(query, budget / 2);
  search.narrow(budget);
  const std::vector<CastRay> rays = search.inOrder();
  std::vector<Vector2d> directions;
  std::vector<FlatlandHit> hits;
  std::vector<Vector2d> borders{Vector2d::UnitX()};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    directions.push_back(directionAt(rays[i].angle));
    hits.push_back(rays[i].hit);
    if (i > 0) borders.push_back(directionAt(rays[i - 1].angle + (rays[i].angle - rays[i - 1].angle) / 2.0));
  }
  borders.emplace_back(-Vector2d::UnitX());
  FlatlandDiscontinuityEstimate result{windowSums(borders, hits), rays.size()};
  const std::span<const Vector2d> between = std::span(borders).subspan(1, rays.size() - 1);
  setDerivatives(result.estimate, radianceBoundary(directions, between, hits));
  requireFinite("discontinuity", result.estimate, hits);
  return result;
}

FlatlandEstimate estimateDiscontinuity(const FlatlandSamples& samples) {
  FlatlandEstimate estimate = strataSums(samples);
  if (samples.size() < 2) return estimate;
  std::vector<Vector2d> between;
  between.reserve(samples.size() - 1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const Vector2d sum = samples.directions[i] + samples.directions[i + 1];
    // Opposite directions are the two ends of the horizon.
    between.push_back(sum.isZero() ? Vector2d(Vector2d::UnitY()) : Vector2d(sum.normalized()));
  }
  setDerivatives(estimate, radianceBoundary(samples.directions, between, samples.hits));
  return estimate;
}

}  // namespace irradiff
