#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiff {

/// The hemisphere cut into slices in which everything stays when the receiver moves in one direction of its tangent
/// plane: by half planes through the line of motion, of equal projected solid angle, each into cells of equal projected
/// solid angle. docs/derivations/reprojection.md, section 1. Depends on the strata and the direction alone.
class EpipolarGrid {
 public:
  static constexpr std::size_t kSlices = 64;
  static constexpr std::size_t kCells = 64;  ///< of each slice, from behind the receiver to ahead of it

  /// For motion at `azimuth` from the tangent towards the bitangent; rad.
  EpipolarGrid(const Strata& strata, double azimuth);

  /// The stratum in which the middle of a cell lies: entry cell * kSlices + slice.
  const std::vector<std::uint32_t>& strata() const { return strata_; }

 private:
  std::vector<std::uint32_t> strata_;
};

/// What a record's samples say of the irradiance at points ahead of it and behind it: each cell has the distance and
/// the radiance of one sample, and between two cells is a wall as far away as the nearer of the two.
class EpipolarSlices {
 public:
  /// Distances below are in multiples of `length`, m, positive: what is computed in float is then of the order of 1.
  /// May be called again with other samples; allocates once. Requires samples of the grid's stratification and shape.
  void fill(const EpipolarGrid& grid, const HemisphereSamples& samples, double length);

  /// At a point ahead of the record (behind, if negative), the nearest surface hiding the others. What nobody saw
  /// behind a near cell has the radiance of the farther neighbour. W/m^2. Error of rounding: 1e-6 times that of the
  /// brightest radiance. Requires a finite distance.
  double irradiance(double distance) const;

  /// The derivative of `irradiance` at the record, from both sides. W/m^2.
  double slope() const;

  /// How fast what nobody saw comes into view behind near cells on a step ahead, and on a step back: projected solid
  /// angle for each multiple of the length, at the record. sr.
  double hiddenAhead() const { return hidden_ahead_; }
  double hiddenBehind() const { return hidden_behind_; }

 private:
  // Entry cell * kSlices + slice.
  std::vector<float> parallax_;  ///< how fast the cotangent of the wall before the cell shrinks with the distance
  std::vector<float> radiance_;  ///< over that of the brightest sample
  double brightest_ = 0.0;       ///< W/(m^2 sr)
  double hidden_ahead_ = 0.0, hidden_behind_ = 0.0;
};

}  // namespace irradiff
