#pragma once

#include "derivatives/error_metric/epipolar_slices.h"
#include "derivatives/error_metric/error_profile.h"
#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace irradiff {

/// What a record's samples say of the irradiance at other points of its tangent plane: cells with the distance and the
/// radiance of the samples are seen again from there, the nearest surface hiding the others, without a new ray.
/// docs/derivations/reprojection.md.
///
/// Unlike a Taylor expansion it sees what lies a step away: a lamp that an occluder in view will cover.
class Reprojection {
 public:
  /// Keeps the samples, which must outlive it.
  explicit Reprojection(const HemisphereSamples& samples);

  /// Predicted irradiance at x + step.t t + step.b b, with the record's normal. W/m^2. Slow, since the slices are made
  /// for one step: for many use ReprojectedErrors. Requires a finite step.
  double irradiance(const Eigen::Vector2d& step) const;

  /// How far the tangent plane is free in the direction of an angle from t, as far as the samples show: there is a
  /// surface beyond, at this horizontal distance, in the stratum on the horizon. m, infinite where nothing is seen.
  double freeDistance(double angle) const;

 private:
  const HemisphereSamples* samples_;
  Strata strata_;
};

/// The projected solid angle in which unseen surroundings change as much as they can, sr: found by trying, from 0.1 to
/// 1 results hardly differ.
inline constexpr double kHiddenMeasure = 0.5;

/// What is predicted of a record's extrapolation to first order, in directions and at distances as in ErrorProfile.
struct ReprojectedError {
  std::vector<double> distances;  ///< m, positive, ascending
  // E'(x + d) - E'(x) - grad E'.d, E' being the reprojected irradiance and grad E' its own gradient: what cells make
  // of the irradiance and of its slope at the record is common to all terms. 0 beyond the free distance. W/m^2; of
  // direction k at distance m: remainders[k * distances.size() + m].
  std::vector<float> remainders;
  /// Of each direction, how fast what the record does not see comes into view from behind nearer surfaces: projected
  /// solid angle for each metre; sr/m.
  std::vector<float> hidden;
  std::vector<double> free_distances;  ///< of each direction; m, may be infinite

  // What is left over beside E + g.d at a step, in the frame (t, b) of the samples: between directions and distances
  // linear, below the first distance quadratic. Nothing beyond the free distance of the nearest direction, or beyond
  // the last distance. W/m^2.
  std::optional<double> remainder(const Eigen::Vector2d& step) const;

  // The profile for a metric: |remainder|, and before the free distance what may come into view unseen. Where m =
  // hidden d has come into view it is filled with what is seen beside it, which holds at first; that the radiance
  // changes within is the more probable the larger m is. So the error is taken for hidden_radiance m^2/kHiddenMeasure.
  // A good choice, W/(m^2 sr), is the mean radiance E/pi of all records (docs/derivations/reprojection.md, section 4).
  // With 0, a record that no light reaches is predicted to be right everywhere.
  ErrorProfile profile(double hidden_radiance) const;

  /// Adds to errors at the same distances in the same directions what may come into view unseen, as `profile` does.
  void addHidden(double hidden_radiance, ErrorProfile& profile) const;
};

/// Tables for reprojecting many records of one stratification and shape.
class ReprojectedErrors {
 public:
  /// In `directions` directions. Throws as Strata, and std::invalid_argument naming the number unless it is even and
  /// positive.
  ReprojectedErrors(Stratification stratification, GridShape shape, std::size_t directions = 16);

  /// May be called from several threads at once. Requires samples of the stratification and shape; finite distances,
  /// positive and ascending, at least one.
  ReprojectedError predict(const HemisphereSamples& samples, std::span<const double> distances) const;

  /// The same with what is not seen at `hidden_radiance`, W/(m^2 sr).
  ErrorProfile profile(const HemisphereSamples& samples, std::span<const double> distances,
                       double hidden_radiance = 0.0) const {
    return predict(samples, distances).profile(hidden_radiance);
  }

 private:
  Strata strata_;
  std::vector<EpipolarGrid> grids_;  ///< of the first half of the directions; the others are behind
};

}  // namespace irradiff
