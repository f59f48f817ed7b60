#pragma once

#include "derivatives/estimators/irradiance_estimate.h"
#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"
#include "derivatives/scene/polygon.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// A parallelogram with the corners centre +- u +- v.
Polygon parallelogram(const std::string& name, const Eigen::Vector3d& centre, const Eigen::Vector3d& u,
                      const Eigen::Vector3d& v, double radiance);

/// The walls and the ceiling, all of one radiance, of the room |x|, |y| <= 1, 0 <= z <= 2, without its floor.
std::vector<Polygon> room(double radiance);

/// What a ray sees, by intersecting it with every polygon.
struct Sight {
  double inverse_distance = 0.0;  ///< 0 if nothing
  double radiance = 0.0;
};

/// Requires convex polygons.
Sight look(std::span<const Polygon> scene, const Eigen::Vector3d& from, const Eigen::Vector3d& direction);

/// Where in its stratum a sample is.
class SamplePlaces {
 public:
  static SamplePlaces centred() { return SamplePlaces(0); }
  /// Independent and uniform in each stratum; `seed` > 0.
  static SamplePlaces jittered(std::uint64_t seed) { return SamplePlaces(seed); }

  Eigen::Vector2d next();

 private:
  explicit SamplePlaces(std::uint64_t seed) : state_(seed) {}

  std::uint64_t state_;
};

SampleFrame frameAt(const Eigen::Vector3d& position);

HemisphereSamples sampleScene(std::span<const Polygon> scene, const SampleFrame& frame, const Strata& strata,
                              SamplePlaces places);

/// The same number for every stratum, for inputs made by hand: directions in the middle of the strata.
HemisphereSamples uniformSamples(const Strata& strata, double distance, double radiance);

/// Of about n x n strata: n/2 x 2n polar, n x n concentric, hemicube of resolution n/2 (3/4 n^2 texels). n is a
/// multiple of 4.
Strata strataOfSize(Stratification stratification, std::size_t n);

inline constexpr Stratification kAllStratifications[] = {Stratification::kPolar, Stratification::kConcentric,
                                                         Stratification::kHemicube};

/// Of the scene itself, by exact visibility, in the frame.
struct SceneDerivatives {
  double irradiance;
  Eigen::Vector3d rotational_gradient;
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;

  Eigen::Vector2d tangentialGradient() const { return gradient.head<2>(); }
  Eigen::Matrix2d tangentialHessian() const { return hessian.topLeftCorner<2, 2>(); }
};

SceneDerivatives trueDerivatives(std::span<const Polygon> scene, const SampleFrame& frame);

/// Positions spread over the part |x|, |y| <= extent of the plane z = 0.
std::vector<Eigen::Vector3d> receivers(std::size_t count, double extent);

double median(std::vector<double> values);

}  // namespace irradiff
