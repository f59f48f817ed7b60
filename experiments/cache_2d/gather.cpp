#include "experiments/cache_2d/gather.h"

#include "experiments/cache_2d/adaptive_integrals.h"
#include "experiments/cache_2d/kernel_curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {
namespace {

constexpr double kQuadratureTolerance = 1e-13;

/// The line of a side as a receiver sees it.
struct LineInView {
  Eigen::Vector2d start, step;  ///< in the receiver's frame: the point at u is start + u step
  double foot;                  ///< coordinate of the nearest point
  double distance;

  LineInView(const WallSide& side, const FlatlandFrame& receiver)
      : start(receiver.local(side.origin)),
        step(receiver.direction(side.tangent)),
        foot(side.local(receiver.position).x()),
        distance(std::abs(side.local(receiver.position).y())) {}
};

/// Sum of L q over the ends less the integral of L' q, q the first `Count` sight terms: [L q] from first to last in
/// each piece of the wall's light. u = foot + d sinh v takes the near pole of the kernel, rho = d cosh v, away.
template <std::size_t Count>
std::array<double, Count> boundaryIntegrals(const LitRoom& room, std::size_t side, const LineInView& line,
                                            const SeenEnd& first, const SeenEnd& last) {
  const DirectLight& light = room.light(side);
  std::array<double, Count> sum{};
  const auto addEnd = [&](const SightTerms& terms, double weight) {
    for (std::size_t i = 0; i < Count; ++i) sum[i] += weight * terms[i];
  };
  std::array<double, Count> tolerance;
  std::copy_n(room.tolerance().begin(), Count, tolerance.begin());
  const std::size_t first_piece = light.pieceAt(first.along);
  for (std::size_t piece = first_piece; piece + 1 < light.borders().size(); ++piece) {
    const bool begins = piece == first_piece;
    const double from = begins ? first.along : light.borders()[piece];
    if (!begins && from >= last.along) break;
    const bool ends = piece + 2 == light.borders().size() || light.borders()[piece + 1] >= last.along;
    const double to = ends ? last.along : light.borders()[piece + 1];
    const auto pointTerms = [&](double along) {
      const Eigen::Vector2d p = line.start + along * line.step;
      return sightTerms(p.x(), p.y());
    };
    addEnd(begins ? first.terms() : pointTerms(from), -room.radiance(side, piece, from).irradiance);
    addEnd(ends ? last.terms() : pointTerms(to), room.radiance(side, piece, to).irradiance);
    if (light.isConstant(piece) || room.reflectance(side) == 0.0 || !(to > from)) continue;
    const auto integrand = [&](double v) {
      const double along = line.foot + line.distance * std::sinh(v);
      const double weight = room.radiance(side, piece, along).slope * line.distance * std::cosh(v);
      const SightTerms terms = pointTerms(along);
      std::array<double, Count> values;
      for (std::size_t i = 0; i < Count; ++i) values[i] = weight * terms[i];
      return values;
    };
    const std::array<double, Count> interior =
        adaptiveIntegrals<Count>(integrand, std::asinh((from - line.foot) / line.distance),
                                 std::asinh((to - line.foot) / line.distance), tolerance);
    for (std::size_t i = 0; i < Count; ++i) sum[i] -= interior[i];
  }
  return sum;
}

/// The integral of cos/rho over what is seen of a line: with theta the angle from the normal to the tangent and theta0
/// that of the foot, 1/rho = cos(theta - theta0)/d.
double inverseDistance(const LineInView& line, const SeenEnd& first, const SeenEnd& last) {
  const auto angle = [](const Eigen::Vector2d& p) { return std::atan2(p.x(), p.y()); };
  const double foot_angle = angle(line.start + line.foot * line.step);
  const auto antiderivative = [&](const SeenEnd& end) {
    const double theta = end.horizon == 0.0 ? angle(end.wall_point) : -end.horizon * std::acos(0.0);
    return 0.5 * (theta * std::cos(foot_angle) + 0.5 * std::sin(2.0 * theta - foot_angle));
  };
  return (antiderivative(first) - antiderivative(last)) / line.distance;
}

}  // namespace

LitRoom::LitRoom(const FlatlandRoom& room, bool has_direct)
    : has_direct_(has_direct), segments_(room.segments), reflectances_(room.reflectances) {
  double label = 0.0;
  for (Segment& segment : segments_) {
    emissions_.push_back(segment.radiance);
    segment.radiance = ++label;
  }
  Eigen::Vector2d low = segments_.front().vertices[0];
  Eigen::Vector2d high = low;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    for (const bool is_right : {false, true}) {
      sides_.push_back(wallSide(segments_[i], i, is_right));
      before_.push_back(segmentsOffLine(segments_, sides_.back()));
      lights_.emplace_back(segments_, emissions_, sides_.back());
    }
    for (const Eigen::Vector2d& vertex : segments_[i].vertices) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
  }
  const double size = (high - low).norm();
  const double bright = kQuadratureTolerance * std::ranges::max(emissions_);
  tolerance_ = {bright, bright / size, bright / size, bright / (size * size), bright};
}

DirectLight::Value LitRoom::radiance(std::size_t side, std::size_t piece, double along) const {
  // Of radiance L from a whole half circle E is 2 L.
  const double share = 0.5 * reflectance(side);
  DirectLight::Value value{has_direct_ ? emissions_[side / 2] : 0.0, 0.0};
  if (share == 0.0) return value;
  const DirectLight::Value direct = lights_[side].at(piece, along);
  value.irradiance += share * direct.irradiance;
  value.slope = share * direct.slope;
  return value;
}

DirectLight::Value LitRoom::radianceBeside(std::size_t side, double along, bool is_last) const {
  std::size_t piece = lights_[side].pieceAt(along);
  if (is_last && piece > 0 && lights_[side].borders()[piece] >= along) --piece;
  return radiance(side, piece, along);
}

FlatlandGather gather(const LitRoom& room, std::span<const SeenPiece> pieces, const FlatlandFrame& receiver) {
  FlatlandGather result;
  result.gradient.setZero();
  double inverse_distance = 0.0;
  for (const SeenPiece& piece : pieces) {
    const std::size_t side = room.sideOf(piece.segment, piece.is_right);
    const LineInView line(room.side(side), receiver);
    const std::array<double, kSightTerms> sums =
        boundaryIntegrals<kSightTerms>(room, side, line, piece.first, piece.last);
    result.irradiance += sums[kSight];
    result.gradient += Eigen::Vector2d(sums[kSightAlong], sums[kSightAcross]);
    result.turn -= sums[kSightTurn];
    result.hessian += sums[kSightCurvature];
    result.unaware_hessian += sums[kSightCurvature];
    for (const bool is_last : {false, true}) {
      const SeenEnd& end = is_last ? piece.last : piece.first;
      const double sign = is_last ? 1.0 : -1.0;
      const SightTerms terms = end.terms();
      const SightTerms wall_terms = end.wallTerms();
      const DirectLight::Value radiance = room.radianceBeside(side, end.along, is_last);
      result.hessian += sign * radiance.slope * end.slide * (terms[kSightAlong] - wall_terms[kSightAlong]);
      result.unaware_hessian += sign * radiance.irradiance * (wall_terms[kSightCurvature] - terms[kSightCurvature]);
      result.unit_irradiance += sign * terms[kSight];
      result.unit_hessian += sign * terms[kSightCurvature];
      result.unit_unaware_hessian += sign * wall_terms[kSightCurvature];
    }
    result.kernel_curvature += kernelCurvature(line.start, line.step, piece.first, piece.last);
    inverse_distance += 0.5 * inverseDistance(line, piece.first, piece.last);
  }
  result.harmonic_mean_distance =
      inverse_distance > 0.0 ? 1.0 / inverse_distance : std::numeric_limits<double>::infinity();
  // What is dark may be rounded to less than nothing, or see a sliver that rounding opened in a corner.
  if (result.irradiance < room.darkness()) result.irradiance = 0.0;
  return result;
}

FlatlandFrame frameOn(const WallSide& side, const Eigen::Vector2d& position) {
  return {position, side.tangent, side.normal};
}

std::vector<SeenPiece> seenFrom(const LitRoom& room, std::size_t side, const Eigen::Vector2d& position,
                                bool* is_at_event) {
  const FlatlandReceiver receiver{position, room.side(side).normal};
  const SegmentVisibility visibility = visibleParts(room.segments(), room.segmentsBefore(side), receiver);
  if (is_at_event != nullptr) *is_at_event = !visibility.no_gradient.empty();
  return seenPieces(visibility.parts, room.segments(), frameOn(room.side(side), position));
}

FlatlandGather gather(const LitRoom& room, std::size_t side, const Eigen::Vector2d& position) {
  bool is_at_event = false;
  const std::vector<SeenPiece> pieces = seenFrom(room, side, position, &is_at_event);
  FlatlandGather result = gather(room, pieces, frameOn(room.side(side), position));
  result.is_at_event = is_at_event;
  return result;
}

double pieceIrradiance(const LitRoom& room, std::size_t side, const FlatlandFrame& receiver, const SeenEnd& first,
                       const SeenEnd& last) {
  return boundaryIntegrals<1>(room, side, LineInView(room.side(side), receiver), first, last)[kSight];
}

}  // namespace irradiff
