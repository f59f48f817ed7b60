#include "derivatives/estimators/seen_line.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace irradiff {

namespace {

/// Half the width of a jump across the plane: what is known of the boundary's place there. A jump along the line has
/// almost none, which says little: the boundary bends by more within it.
double halfWidthAcross(const RadianceJump& jump, const Eigen::Vector3d& plane_normal) {
  constexpr double kLeast = 0.02;
  const double across = 0.5 * std::abs(plane_normal.dot(jump.a.direction - jump.b.direction));
  return std::max(across, kLeast * jump.halfWidth());
}

Eigen::Vector3d fittedPlane(std::span<const RadianceJump> jumps, std::span<const std::size_t> chosen,
                            const Eigen::Vector3d& guess) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::size_t i : chosen) {
    const Eigen::Vector3d w = jumps[i].middle() / halfWidthAcross(jumps[i], guess);
    moments += w * w.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments / moments.trace());
  return solver.eigenvectors().col(0);
}

Eigen::Vector3d fittedDepth(std::span<const RadianceJump> jumps, std::span<const std::size_t> chosen,
                            const Eigen::Vector3d& plane_normal) {
  const Eigen::Vector3d first = jumps[chosen.front()].middle();
  const Eigen::Vector3d x = (first - plane_normal * plane_normal.dot(first)).normalized();
  const Eigen::Vector3d y = plane_normal.cross(x);
  double narrowest = jumps[chosen.front()].halfWidth();
  for (const std::size_t i : chosen) narrowest = std::min(narrowest, jumps[i].halfWidth());
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const std::size_t i : chosen) {
    // Not where the nearer ray is: neighbouring wide jumps may share it.
    const Eigen::Vector3d w = jumps[i].middle();
    const Eigen::Vector2d place(x.dot(w), y.dot(w));
    const double relative_width = jumps[i].halfWidth() / narrowest;
    const double weight = 1.0 / (relative_width * relative_width);
    moments += weight * place * place.transpose();
    right += weight * jumps[i].nearer().inverse_distance * place;
  }
  const Eigen::Vector2d depth = moments.ldlt().solve(right);
  return x * depth(0) + y * depth(1);
}

}  // namespace

// Squares of what is very far or near are out of range.
double SeenLine::inverseFootDistance() const { return depth.stableNorm(); }

double SeenLine::inverseDistance(const Eigen::Vector3d& direction) const { return std::max(0.0, depth.dot(direction)); }

Eigen::Vector3d SeenLine::edgeDirection() const {
  const double inverse_foot_distance = inverseFootDistance();
  if (inverse_foot_distance > 0.0) return plane_normal.cross(depth) / inverse_foot_distance;
  return plane_normal.unitOrthogonal();
}

std::optional<SeenLine> fitLine(std::span<const RadianceJump> jumps, std::span<const std::size_t> chosen) {
  constexpr int kReweightings = 2;
  const Eigen::Vector3d moment = jumps[chosen.front()].middle().cross(jumps[chosen.back()].middle());
  const double sine = moment.norm();
  if (!(sine > 0.0)) return std::nullopt;
  SeenLine line{moment / sine, {}};
  if (chosen.size() > 2) {
    for (int i = 0; i < kReweightings; ++i) line.plane_normal = fittedPlane(jumps, chosen, line.plane_normal);
  }
  line.depth = fittedDepth(jumps, chosen, line.plane_normal);
  if (!line.plane_normal.allFinite() || !line.depth.allFinite()) return std::nullopt;
  return line;
}

bool partsJumps(const SeenLine& line, std::span<const RadianceJump> jumps, std::span<const std::size_t> chosen) {
  // Of the width of a jump: least squares do not put the line between the rays of every jump exactly.
  constexpr double kBeyondRays = 0.25;
  // Of the width times the largest inverse distance: how fast distances change along surfaces is not known.
  constexpr double kDepthChange = 4.0;
  constexpr double kRounding = 1e-12;
  return std::all_of(chosen.begin(), chosen.end(), [&](std::size_t i) {
    const RadianceJump& jump = jumps[i];
    const double at_a = line.plane_normal.dot(jump.a.direction);
    const double at_b = line.plane_normal.dot(jump.b.direction);
    const double slack = kBeyondRays * std::abs(at_a - at_b) + kRounding;
    if (std::min(at_a, at_b) > slack || std::max(at_a, at_b) < -slack) return false;
    const SeenPoint& seen = jump.nearer();
    const double size = seen.inverse_distance + line.inverseFootDistance();
    return std::abs(seen.inverse_distance - line.depth.dot(jump.middle())) <=
           (kDepthChange * jump.halfWidth() + kRounding) * size;
  });
}

std::optional<Eigen::Vector3d> cornerBetween(const LineEnd& end, const LineEnd& start) {
  constexpr double kParallel = 1e-9;  // rad
  // Of the gap and of the spacing of jumps: those are not even.
  constexpr double kBeyond = 1.5;
  const Eigen::Vector3d crossing = end.line.plane_normal.cross(start.line.plane_normal);
  const double sine = crossing.norm();
  if (!(sine > kParallel)) return std::nullopt;
  const Eigen::Vector3d a = end.jump.middle();
  const Eigen::Vector3d b = start.jump.middle();
  const Eigen::Vector3d middle = (a + b).normalized();
  const Eigen::Vector3d corner = crossing / (crossing.dot(middle) < 0.0 ? -sine : sine);
  const double gap = (a - b).norm() + end.jump.halfWidth() + start.jump.halfWidth();
  if ((corner - middle).norm() > kBeyond * (gap + std::max(end.spacing, start.spacing))) return std::nullopt;
  return corner;
}

}  // namespace irradiff
