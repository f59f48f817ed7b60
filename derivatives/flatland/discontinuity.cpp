#include "derivatives/flatland/discontinuity.h"

#include "derivatives/flatland/hit_line.h"
#include "derivatives/flatland/radiance_points.h"
#include "derivatives/flatland/radiance_windows.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

/// Counterclockwise.
struct OrderedRays {
  std::vector<double> angles;
  std::vector<Vector2d> directions;
  std::vector<FlatlandHit> hits;

  std::size_t size() const { return hits.size(); }
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

  OrderedRays inOrder() const {
    std::vector<CastRay> rays = rays_;
    std::sort(rays.begin(), rays.end(), [](const CastRay& a, const CastRay& b) { return a.angle < b.angle; });
    OrderedRays ordered;
    for (const CastRay& ray : rays) {
      ordered.angles.push_back(ray.angle);
      ordered.directions.push_back(directionAt(ray.angle));
      ordered.hits.push_back(ray.hit);
    }
    return ordered;
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

/// dL/dphi on the surface that ray `from` hits, on its counterclockwise side (step 1) or the other (step -1): the
/// lesser of two differences that follow each other, each over an angle of about `spacing`; 0 if the surface ends
/// before or they have different signs. A jump makes one of them large, not both.
double radianceSlope(const OrderedRays& rays, std::size_t from, int step, double spacing) {
  std::array<double, 2> slopes{};
  std::size_t found = 0;
  std::size_t last = from;
  for (std::size_t i = from; found < slopes.size();) {
    if (step > 0 ? i + 1 == rays.size() : i == 0) return 0.0;
    if (!onOneSurface(rays.directions, rays.hits, step > 0 ? i : i - 1)) return 0.0;
    i = step > 0 ? i + 1 : i - 1;
    const double angle = rays.angles[i] - rays.angles[last];
    if (std::abs(angle) < 0.75 * spacing) continue;
    slopes[found++] = (rays.hits[i].radiance - rays.hits[last].radiance) / angle;
    last = i;
  }
  if ((slopes[0] > 0.0) != (slopes[1] > 0.0)) return 0.0;
  return std::abs(slopes[0]) < std::abs(slopes[1]) ? slopes[0] : slopes[1];
}

/// The jump at the end of what is in front changes as the sight line past that end slides over what is behind:
//   hess E -= sum over ends of sigma dL/dphi (n.w) (u_near - u_far)^2 (J w) (J w)^T,
// dL/dphi beside the end on the far side, sigma = 1 if that is the counterclockwise one and -1 if not.
// docs/derivations/flatland.md, section 6.
Eigen::Matrix2d slidingTerm(const OrderedRays& rays, std::span<const Vector2d> between, double spacing) {
  Eigen::Matrix2d term = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < between.size(); ++i) {
    const double rise = rays.hits[i + 1].inverse_distance - rays.hits[i].inverse_distance;
    if (rise == 0.0 || onOneSurface(rays.directions, rays.hits, i)) continue;
    const double slope = rise < 0.0 ? radianceSlope(rays, i + 1, 1, spacing) : -radianceSlope(rays, i, -1, spacing);
    if (slope == 0.0) continue;
    const Vector2d across = quarterTurn(between[i]);
    term -= slope * between[i].y() * rise * rise * across * across.transpose();
  }
  return term;
}

}  // namespace

FlatlandDiscontinuityEstimate estimateFromFlatlandDiscontinuities(const FlatlandRayQuery& query, std::size_t budget) {
  if (budget < kFewestFlatlandDiscontinuityRays) {
    throw std::invalid_argument("flatland discontinuity estimator: a budget of " + std::to_string(budget) +
                                " rays, must be at least " + std::to_string(kFewestFlatlandDiscontinuityRays));
  }
  const std::size_t first_rays = budget / 2;
  JumpSearch search(query, first_rays);
  search.narrow(budget);
  const OrderedRays rays = search.inOrder();
  std::vector<Vector2d> borders{Vector2d::UnitX()};
  for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
    borders.push_back(directionAt(rays.angles[i] + (rays.angles[i + 1] - rays.angles[i]) / 2.0));
  }
  borders.emplace_back(-Vector2d::UnitX());
  FlatlandDiscontinuityEstimate result{windowSums(borders, rays.hits), rays.size()};
  const std::span<const Vector2d> between = std::span(borders).subspan(1, rays.size() - 1);
  setDerivatives(result.estimate, radianceBoundary(rays.directions, between, rays.hits));
  *result.estimate.hessian += slidingTerm(rays, between, std::numbers::pi / static_cast<double>(first_rays));
  result.estimate.tangential_hessian = (*result.estimate.hessian)(0, 0);
  requireFinite("discontinuity", result.estimate, rays.hits);
  return result;
}

FlatlandEstimate estimateDiscontinuity(const FlatlandSamples& samples) {
  FlatlandEstimate estimate = strataSums(samples);
  if (samples.size() < 2) return estimate;
  std::vector<Vector2d> between;
  between.reserve(samples.size() - 1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    // 0 between the two ends of the horizon, and adds nothing.
    between.push_back((samples.directions[i] + samples.directions[i + 1]).normalized());
  }
  setDerivatives(estimate, radianceBoundary(samples.directions, between, samples.hits));
  return estimate;
}

}  // namespace irradiff
