#include "derivatives/estimators/corner_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace irradiff {

namespace {

/// Corners whose jumps are nearer than this, rad, are as good as looked at.
constexpr double kNearest = 1e-6;

/// How far from a corner the ray goes, in parts of the distance to the nearer jump.
constexpr double kBesideCorner = 1e-3;

/// How far from a line the search for a cut starts, in parts of the jump's distance from the corner.
constexpr double kBesideLine = 0.05;

/// A jump on a cut is between rays as far apart as the corner's jumps at first, and must come so near to the cut that
/// it is not taken for one on the lines beside it.
constexpr int kHalvings = 16;

/// At most: a ray beside the corner, then one beside each line and its halvings.
constexpr std::size_t kMostRays = 1 + 2 * (1 + kHalvings);

/// One of the two lines that make a corner.
struct Side {
  const SeenLine* line;
  const RadianceJump* jump;
  Eigen::Vector3d place;    ///< of the jump, on the line
  Eigen::Vector3d tangent;  ///< unit, from the corner along the line
  double distance;          ///< of the jump from the corner
};

Side sideOf(const SeenLine& line, const RadianceJump& jump, const Eigen::Vector3d& corner) {
  const Eigen::Vector3d w = jump.middle();
  const Eigen::Vector3d place = (w - line.plane_normal * line.plane_normal.dot(w)).normalized();
  const Eigen::Vector3d along = place - corner * corner.dot(place);
  const double distance = along.norm();
  return {&line, &jump, place, along / distance, distance};
}

Eigen::Vector3d aboveHorizon(const Eigen::Vector3d& direction) {
  return Eigen::Vector3d(direction(0), direction(1), std::max(0.0, direction(2))).normalized();
}

}  // namespace

bool CornerProbe::findCuts(JumpGraph& graph, std::vector<JumpChain>& chains, std::span<const TracedChain> traced,
                           RayBudget& rays) {
  // Where to put two jumps into which chain.
  struct Cut {
    std::size_t chain;
    std::size_t before, after;
    std::array<RadianceJump, 2> jumps;
  };
  std::vector<Cut> cuts;
  const auto lookAt = [&](std::size_t chain, const StraightRun& run, const StraightRun& next) {
    if (!run.line || !next.line || rays.left() < kMostRays) return;
    const auto corner = cornerBetween(lastEnd(run, graph.jumps), firstEnd(next, graph.jumps));
    const std::pair<std::size_t, std::size_t> beside(run.jumps.back(), next.jumps.front());
    if (!corner || (*corner)(2) <= 0.0 || std::find(seen_.begin(), seen_.end(), beside) != seen_.end()) return;
    seen_.push_back(beside);
    const std::array<Side, 2> sides{sideOf(*run.line, graph.jumps[beside.first], *corner),
                                    sideOf(*next.line, graph.jumps[beside.second], *corner)};
    const double nearest = std::min(sides[0].distance, sides[1].distance);
    const Eigen::Vector3d inside = sides[0].tangent + sides[1].tangent;
    if (!(nearest > kNearest) || !(inside.norm() > kBesideCorner)) return;

    // The region inside the angle, by the first line.
    const RadianceJump& jump = *sides[0].jump;
    const double across = sides[0].line->plane_normal.dot(inside);
    const bool is_a = sides[0].line->plane_normal.dot(jump.a.direction - jump.b.direction) * across > 0.0;
    const double radiance_inside = is_a ? jump.radiance_a : jump.radiance_b;
    const double radiance_outside = is_a ? jump.radiance_b : jump.radiance_a;
    const auto isInside = [&](const SeenPoint& seen) {
      return std::abs(seen.radiance - radiance_inside) <= std::abs(seen.radiance - radiance_outside);
    };
    const SeenPoint at_corner = rays.cast(aboveHorizon(*corner + kBesideCorner * nearest * inside.normalized()));
    if (isInside(at_corner)) return;

    Cut cut{chain, beside.first, beside.second, {}};
    for (std::size_t i = 0; i < 2; ++i) {
      const Side& side = sides[i];
      const Eigen::Vector3d inward = side.line->plane_normal * (side.line->plane_normal.dot(inside) > 0.0 ? 1.0 : -1.0);
      const SeenPoint start = rays.cast(aboveHorizon(side.place + kBesideLine * side.distance * inward));
      if (!isInside(start)) return;
      cut.jumps[i] = {start, at_corner, radiance_inside, radiance_outside};
      for (int k = 0; k < kHalvings; ++k) cut.jumps[i].narrow(rays.cast(cut.jumps[i].middle()));
    }
    cuts.push_back(cut);
  };
  for (std::size_t i = 0; i < traced.size(); ++i) {
    const std::vector<StraightRun>& runs = traced[i].runs;
    for (std::size_t k = 0; k + 1 < runs.size(); ++k) lookAt(i, runs[k], runs[k + 1]);
    if (traced[i].is_closed && runs.size() > 1) lookAt(i, runs.back(), runs.front());
  }
  for (const Cut& cut : cuts) {
    std::vector<std::size_t>& chain = chains[cut.chain].jumps;
    chain.insert(std::find(chain.begin(), chain.end(), cut.before) + 1, graph.jumps.size());
    graph.jumps.push_back(cut.jumps[0]);
    chain.insert(std::find(chain.begin(), chain.end(), cut.after), graph.jumps.size());
    graph.jumps.push_back(cut.jumps[1]);
  }
  return !cuts.empty();
}

}  // namespace irradiff
