#pragma once

#include "derivatives/flatland/flatland_strata.h"
#include "derivatives/flatland/segment_form.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace irradiff {

/// The frame (t, n) of a receiver with unit normal n, t a quarter turn clockwise of n, as columns: takes components in
/// the frame to the world. For n = (0, 1): t = (1, 0).
inline Eigen::Matrix2d flatlandFrame(const Eigen::Vector2d& normal) {
  Eigen::Matrix2d axes;
  axes << -quarterTurn(normal), normal;
  return axes;
}

/// What a ray from the receiver sees.
struct FlatlandHit {
  double inverse_distance = 0.0;  ///< 1/m, finite, >= 0; 0 if the ray hits nothing
  double radiance = 0.0;          ///< W/(m rad), finite, >= 0
};

/// Casts one ray from the receiver in a unit direction of the frame (t, n) that is not below the horizon.
using FlatlandRayQuery = std::function<FlatlandHit(const Eigen::Vector2d& direction)>;

/// What was seen from a receiver along one ray in each stratum, counterclockwise. The flatland counterpart of
/// HemisphereSamples.
struct FlatlandSamples {
  FlatlandStrata strata;
  std::vector<Eigen::Vector2d> directions;  ///< unit, in the frame (t, n), each inside its stratum
  std::vector<FlatlandHit> hits;

  std::size_t size() const { return hits.size(); }
};

/// One ray through each stratum, at offsets[i] in [0, 1] of the way through stratum i. Requires as many offsets as
/// there are strata.
FlatlandSamples sampleHalfCircle(const FlatlandStrata& strata, std::span<const double> offsets,
                                 const FlatlandRayQuery& cast_ray);

}  // namespace irradiff
