#pragma once

#include "experiments/cache_2d/direct_light.h"
#include "experiments/cache_2d/flatland_room.h"
#include "experiments/cache_2d/seen_piece.h"
#include "experiments/cache_2d/wall_side.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// A room with the direct light on the walls that reflect, and so the radiance that leaves them after one bounce.
class LitRoom {
 public:
  /// `has_direct`: emitters are seen too; otherwise they only light the walls.
  LitRoom(const FlatlandRoom& room, bool has_direct);

  /// Each with a radiance of its own, which is no light.
  std::span<const Segment> segments() const { return segments_; }
  std::size_t sideOf(std::size_t segment, bool is_right) const { return 2 * segment + (is_right ? 1 : 0); }
  const WallSide& side(std::size_t side) const { return sides_[side]; }
  const DirectLight& light(std::size_t side) const { return lights_[side]; }
  double reflectance(std::size_t side) const { return reflectances_[side / 2]; }
  /// What a receiver on a side cannot have behind itself: all segments but those on its line.
  const std::vector<std::size_t>& segmentsBefore(std::size_t side) const { return before_[side]; }

  /// Radiance rho E/2 (and emission) that leaves a side and its slope along the wall, in a piece of its DirectLight.
  DirectLight::Value radiance(std::size_t side, std::size_t piece, double along) const;

  /// The same where what is seen of the side begins or ends: the limit from inside.
  DirectLight::Value radianceBeside(std::size_t side, double along, bool is_last) const;

  /// Irradiance below this is none: 1e-12 of the brightest emitter; W/m.
  double darkness() const { return 10.0 * tolerance_[kSight]; }
  /// Tolerances of quadrature: 1e-13 of the brightest emitter, over powers of the room's size.
  const SightTerms& tolerance() const { return tolerance_; }

 private:
  bool has_direct_;
  std::vector<Segment> segments_;
  std::vector<double> emissions_, reflectances_;
  std::vector<WallSide> sides_;
  std::vector<DirectLight> lights_;
  std::vector<std::vector<std::size_t>> before_;
  SightTerms tolerance_{};
};

/// What a receiver gathers, in closed form but for one quadrature: derivatives are with respect to the receiver's place
/// in its own frame. docs/derivations/flatland_bounce.md, sections 3 to 5.
struct FlatlandGather {
  double irradiance = 0.0;   ///< W/m
  Eigen::Vector2d gradient;  ///< along tangent and normal; W/m^2
  double turn = 0.0;         ///< dE/dalpha, counterclockwise; W/(m rad)
  double hessian = 0.0;      ///< second derivative along the tangent; W/m^3
  /// The Hessian if each thing seen were static on its wall: what occlusion hides or shows is left out.
  double unaware_hessian = 0.0;
  // The same quantities if all walls had radiance 1.
  double unit_irradiance = 0.0;
  double unit_hessian = 0.0;
  double unit_unaware_hessian = 0.0;
  /// The integral over the walls seen of the absolute second derivative of the kernel: the unaware Hessian of the least
  /// favourable radiance between -1 and 1. 1/m^2.
  double kernel_curvature = 0.0;
  double harmonic_mean_distance = 0.0;  ///< m, infinite where nothing is seen
  bool is_at_event = false;             ///< then derivatives are those of one of the sides
};

FlatlandFrame frameOn(const WallSide& side, const Eigen::Vector2d& position);

/// Requires a position on no segment but those on the line of its side.
FlatlandGather gather(const LitRoom& room, std::size_t side, const Eigen::Vector2d& position);

/// The same from the pieces a receiver sees.
FlatlandGather gather(const LitRoom& room, std::span<const SeenPiece> pieces, const FlatlandFrame& receiver);

/// What the receiver at `position` on a side sees; also whether it is at a visibility event, if asked.
std::vector<SeenPiece> seenFrom(const LitRoom& room, std::size_t side, const Eigen::Vector2d& position,
                                bool* is_at_event = nullptr);

/// Irradiance of part of a side, between two coordinates on it, from a receiver in whose frame it is seen so far.
double pieceIrradiance(const LitRoom& room, std::size_t side, const FlatlandFrame& receiver, const SeenEnd& first,
                       const SeenEnd& last);

}  // namespace irradiff
