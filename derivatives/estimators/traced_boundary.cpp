#include "derivatives/estimators/traced_boundary.h"

#include "derivatives/boundary/boundary_sums.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace irradiff {

namespace {

const Eigen::Vector3d kNormal(0.0, 0.0, 1.0);

/// Where a boundary reaches the horizon, with the radiance to both sides.
struct HorizonPoint {
  double azimuth;
  double counterclockwise, clockwise;
};

/// Where an arc ends, and the line in front of which, or behind which, it does.
struct ArcLimit {
  Eigen::Vector3d direction;
  const SeenLine* crossing = nullptr;  ///< none where what ends the arc is not known
};

Eigen::Vector3d onto(const SeenLine& line, const Eigen::Vector3d& direction) {
  return (direction - line.plane_normal * line.plane_normal.dot(direction)).normalized();
}

/// An end of a run.
struct RunEnd {
  const StraightRun* run = nullptr;
  bool is_last = false;

  std::size_t jump() const { return is_last ? run->jumps.back() : run->jumps.front(); }
};

class BoundaryTracing {
 public:
  BoundaryTracing(const JumpGraph& graph, std::span<const TracedChain> chains)
      : graph_(graph),
        chains_(chains),
        junction_of_(graph.jumps.size()),
        end_at_(graph.jumps.size()),
        is_on_rim_(graph.jumps.size(), false) {
    for (const std::vector<std::size_t>& junction : graph.junctions) {
      for (const std::size_t jump : junction) junction_of_[jump] = &junction;
    }
    for (const std::size_t jump : graph.rim) is_on_rim_[jump] = true;
    for (const TracedChain& chain : chains) {
      if (chain.is_closed) continue;
      end_at_[chain.first] = {&chain.runs.front(), false};
      end_at_[chain.last] = {&chain.runs.back(), true};
    }
  }

  IrradianceDerivatives<double> derivatives() {
    for (const TracedChain& chain : chains_) addChain(chain);
    addHorizon();
    IrradianceDerivatives<double> sum = boundarySums(boundary_, kNormal).derivatives;
    const Eigen::Matrix3d vertices = 0.5 * (vertex_hessian_ + vertex_hessian_.transpose());
    sum.hessian.value += vertices;
    sum.tangential_hessian.value += vertices.topLeftCorner<2, 2>();
    return sum;
  }

 private:
  const RadianceJump& jump(std::size_t number) const { return graph_.jumps[number]; }

  void addChain(const TracedChain& chain) {
    const std::vector<StraightRun>& runs = chain.runs;
    const std::size_t count = runs.size();
    for (std::size_t i = 0; i < count; ++i) {
      const StraightRun* before = i > 0 || chain.is_closed ? &runs[(i + count - 1) % count] : nullptr;
      const StraightRun* after = i + 1 < count || chain.is_closed ? &runs[(i + 1) % count] : nullptr;
      if (count == 1) before = after = nullptr;
      const RunEnd first{&runs[i], false};
      const RunEnd last{&runs[i], true};
      const ArcLimit start = before != nullptr ? between(first, {before, true}) : chainEnd(first, chain.first);
      const ArcLimit end = after != nullptr ? between(last, {after, false}) : chainEnd(last, chain.last);
      if (runs[i].line) addRun(*runs[i].line, runs[i], start, end);
      if (after != nullptr && end.crossing == nullptr) addChord(jump(last.jump()), jump(after->jumps.front()));
    }
  }

  LineEnd lineEnd(const RunEnd& end) const {
    return end.is_last ? lastEnd(*end.run, graph_.jumps) : firstEnd(*end.run, graph_.jumps);
  }

  ArcLimit between(const RunEnd& end, const RunEnd& next) const {
    if (end.run->line && next.run->line) {
      if (const auto corner = cornerBetween(lineEnd(end), lineEnd(next))) return {*corner, &*next.run->line};
    }
    return {jump(end.jump()).middle(), nullptr};
  }

  /// `at` is the chain's own last jump, which may have been left out of its runs.
  ArcLimit chainEnd(const RunEnd& end, std::size_t at) {
    if (junction_of_[at] != nullptr) return atJunction(end, at, *junction_of_[at]);
    if (is_on_rim_[at]) return atHorizon(*end.run, end.jump());
    return {jump(end.jump()).middle(), nullptr};
  }

  ArcLimit atJunction(const RunEnd& end, std::size_t at, const std::vector<std::size_t>& junction) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const RunEnd* most_transversal = nullptr;
    double largest_sine = 0.0;
    for (const std::size_t other : junction) {
      sum += jump(other).middle();
      const RunEnd& candidate = end_at_[other];
      if (other == at || candidate.run == nullptr || !candidate.run->line || !end.run->line) continue;
      const double sine = end.run->line->plane_normal.cross(candidate.run->line->plane_normal).norm();
      if (sine > largest_sine) {
        largest_sine = sine;
        most_transversal = &candidate;
      }
    }
    if (most_transversal != nullptr) {
      ArcLimit limit = between(end, *most_transversal);
      if (limit.crossing != nullptr) return limit;
    }
    return {sum.normalized(), nullptr};
  }

  ArcLimit atHorizon(const StraightRun& run, std::size_t end) {
    constexpr double kFarthest = 0.5;  // rad; a line that goes on further is almost parallel to the horizon
    Eigen::Vector3d direction = jump(end).middle();
    Eigen::Vector3d plane_normal = kNormal.cross(jump(end).a.direction - jump(end).b.direction).cross(kNormal);
    if (run.line) {
      plane_normal = run.line->plane_normal;
      const Eigen::Vector3d horizon = plane_normal.cross(kNormal);
      const double sine = horizon.norm();
      if (sine > 0.0) {
        const Eigen::Vector3d reached = horizon / (horizon.dot(direction) < 0.0 ? -sine : sine);
        if ((reached - direction).norm() <= kFarthest) direction = reached;
      }
    }
    const Eigen::Vector3d counterclockwise(-direction(1), direction(0), 0.0);
    const bool is_a =
        (jump(end).a.direction - jump(end).b.direction).dot(plane_normal) * plane_normal.dot(counterclockwise) > 0.0;
    horizon_points_.push_back({std::atan2(direction(1), direction(0)),
                               is_a ? jump(end).radiance_a : jump(end).radiance_b,
                               is_a ? jump(end).radiance_b : jump(end).radiance_a});
    return {direction, nullptr};
  }

  void addRun(SeenLine line, const StraightRun& run, const ArcLimit& start, const ArcLimit& end) {
    const Eigen::Vector3d first = onto(line, start.direction);
    const Eigen::Vector3d last = onto(line, end.direction);
    // The plane's normal is that of the arc travelled from first to last. From horizon to horizon it may be half a
    // circle, of which both ends together do not tell the way.
    const RadianceJump& between = jump(run.jumps[run.jumps.size() / 2]);
    const Eigen::Vector3d middle = onto(line, between.middle());
    const bool is_long = first.dot(last) < 0.0;
    const Eigen::Vector3d moment =
        is_long ? Eigen::Vector3d(first.cross(middle) + middle.cross(last)) : first.cross(last);
    if (line.plane_normal.dot(moment) < 0.0) line.plane_normal = -line.plane_normal;
    const double radiance_jump = between.jumpAcross(line.plane_normal);
    if (is_long) {
      addArc(line, first, middle, radiance_jump);
      addArc(line, middle, last, radiance_jump);
    } else {
      addArc(line, first, last, radiance_jump);
    }
    if (start.crossing != nullptr) addVertex(line, first, *start.crossing, -radiance_jump);
    if (end.crossing != nullptr) addVertex(line, last, *end.crossing, radiance_jump);
  }

  void addChord(const RadianceJump& from, const RadianceJump& to) {
    const Eigen::Vector3d first = from.middle();
    const Eigen::Vector3d last = to.middle();
    const Eigen::Vector3d moment = first.cross(last);
    const double sine = moment.norm();
    if (!(sine > 0.0)) return;
    // The combination of both directions that has both inverse distances.
    const double cosine = first.dot(last);
    const double kappa0 = from.nearer().inverse_distance;
    const double kappa1 = to.nearer().inverse_distance;
    const double square = sine * sine;
    const SeenLine chord{moment / sine,
                         first * ((kappa0 - cosine * kappa1) / square) + last * ((kappa1 - cosine * kappa0) / square)};
    addArc(chord, first, last, from.jumpAcross(chord.plane_normal));
  }

  void addArc(const SeenLine& line, const Eigen::Vector3d& first, const Eigen::Vector3d& last, double radiance_jump) {
    constexpr double kLongest = 1.0;  // rad; ArcMoments are made for at most 2
    const double angle = std::atan2(first.cross(last).norm(), first.dot(last));
    if (angle > kLongest) {
      const Eigen::Vector3d middle = (first + last).normalized();
      addArc(line, first, middle, radiance_jump);
      addArc(line, middle, last, radiance_jump);
      return;
    }
    const auto arcEnd = [&](const Eigen::Vector3d& direction) {
      return ArcEnd<double>{direction, line.inverseDistance(direction), std::max(0.0, direction(2))};
    };
    BoundaryArc<double> arc;
    arc.plane_normal = line.plane_normal;
    arc.turned_plane_normal = kNormal.cross(line.plane_normal);
    arc.edge_direction = line.edgeDirection();
    arc.angle = angle;
    arc.angle_over_foot_distance = angle * line.inverseFootDistance();
    arc.cancellation_distance = 0.0;  // for bounds of rounding errors, which are far below those of the tracing
    arc.first = arcEnd(first);
    arc.last = arcEnd(last);
    arc.radiance_jump = radiance_jump;
    boundary_.arcs.push_back(arc);
  }

  // The arc's end moves along the edge e by dt*/dx = (1 - kappa'/kappa) m'/(m'.e) where another line with plane normal
  // m' and inverse distance kappa' cuts it; what that adds to the Hessian is jump (r x e) (n.w) kappa^3 (dt*/dx)^T.
  void addVertex(const SeenLine& line, const Eigen::Vector3d& direction, const SeenLine& other, double signed_jump) {
    const double kappa = line.inverseDistance(direction);
    const double across = other.plane_normal.dot(line.edgeDirection());
    if (!(kappa > 0.0) || across == 0.0 || !(direction(2) > 0.0)) return;
    const double relative_motion = (1.0 - other.inverseDistance(direction) / kappa) / across;
    const double weight =
        signed_jump * direction(2) * kappa * kappa * (kappa / line.inverseFootDistance()) * relative_motion;
    vertex_hessian_ += weight * line.plane_normal * other.plane_normal.transpose();
  }

  void addHorizon() {
    std::sort(horizon_points_.begin(), horizon_points_.end(),
              [](const HorizonPoint& a, const HorizonPoint& b) { return a.azimuth < b.azimuth; });
    if (horizon_points_.empty()) {
      boundary_.horizon_angle = 2.0 * std::numbers::pi * graph_.horizon_radiance;
      return;
    }
    for (std::size_t i = 0; i < horizon_points_.size(); ++i) {
      const HorizonPoint& here = horizon_points_[i];
      const bool is_last = i + 1 == horizon_points_.size();
      const HorizonPoint& next = horizon_points_[is_last ? 0 : i + 1];
      const double angle = next.azimuth - here.azimuth + (is_last ? 2.0 * std::numbers::pi : 0.0);
      boundary_.horizon_angle += 0.5 * (here.counterclockwise + next.clockwise) * angle;
    }
  }

  const JumpGraph& graph_;
  std::span<const TracedChain> chains_;
  std::vector<const std::vector<std::size_t>*> junction_of_;
  std::vector<RunEnd> end_at_;  ///< of each jump at which a chain begins or ends
  std::vector<bool> is_on_rim_;
  std::vector<HorizonPoint> horizon_points_;
  RadianceBoundary<double> boundary_;
  Eigen::Matrix3d vertex_hessian_ = Eigen::Matrix3d::Zero();
};

}  // namespace

IrradianceDerivatives<double> tracedDerivatives(const JumpGraph& graph, std::span<const TracedChain> chains) {
  return BoundaryTracing(graph, chains).derivatives();
}

}  // namespace irradiff
