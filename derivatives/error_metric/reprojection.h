#pragma once

#include "derivatives/samples/hemisphere_samples.h"

#include <Eigen/Core>

#include <memory>

namespace irradiff {

/// What a record's samples say of the irradiance at other points of its tangent plane: the mesh over the samples is
/// seen again from there, the nearest surface hiding the others, without a new ray. docs/derivations/reprojection.md.
///
/// Unlike a Taylor expansion it sees what lies a step away: a lamp that an occluder in view will cover.
class Reprojection {
 public:
  explicit Reprojection(const HemisphereSamples& samples);
  ~Reprojection();
  Reprojection(Reprojection&&) noexcept;
  Reprojection& operator=(Reprojection&&) noexcept;

  /// Predicted irradiance at x + step.t t + step.b b, with the record's normal. W/m^2.
  double irradiance(const Eigen::Vector2d& step) const;

  /// How far the tangent plane is free in the direction of an angle from t, as far as the samples show: there is a
  /// surface beyond. m, infinite where nothing is seen.
  double freeDistance(double angle) const;

 private:
  struct Seen;
  std::unique_ptr<Seen> seen_;
};

}  // namespace irradiff
