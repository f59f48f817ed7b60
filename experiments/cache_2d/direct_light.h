#pragma once

#include "derivatives/scene/segment.h"
#include "experiments/cache_2d/wall_side.h"

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// Direct irradiance along one side of a wall in closed form. Between the events of the view (shadow boundaries and all
/// other places where two points of the scene are in line) the same boundary points of emitters are seen, and
///   E(u) = constant + sum over points of weight S(p - u),  S = -x/rho (sight_terms.h),
/// so E and dE/du have no error but rounding and that of the events' places, 1e-13 of the wall.
/// docs/derivations/flatland_bounce.md, section 2.
class DirectLight {
 public:
  struct Value {
    double irradiance = 0.0;  ///< W/m
    double slope = 0.0;       ///< along the wall; W/m^2
  };

  DirectLight() = default;
  /// `segments` have a radiance of their own each, so that no event is taken for none; `emissions` are what they
  /// radiate.
  DirectLight(std::span<const Segment> segments, std::span<const double> emissions, const WallSide& side);

  /// Ascending from 0 to the length of the wall: where one closed form ends and another begins.
  const std::vector<double>& borders() const { return borders_; }
  /// Inside piece i, from border i to border i + 1; at these the limits from inside.
  Value at(std::size_t piece, double along) const;
  /// Number of the piece that holds a coordinate; of two the latter.
  std::size_t pieceAt(double along) const;
  bool isConstant(std::size_t piece) const { return pieces_[piece].points.empty(); }
  /// The most irradiance in the middle of a piece.
  double brightest() const;

 private:
  struct LightPoint {
    double weight, along, height;
    bool operator==(const LightPoint&) const = default;
  };
  struct Piece {
    double constant = 0.0;
    std::vector<LightPoint> points;
    bool operator==(const Piece&) const = default;
  };

  std::vector<double> borders_;
  std::vector<Piece> pieces_;
};

}  // namespace irradiff
