#pragma once

#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/stratification.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "experiments/cache_3d/room_gather.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace irradiff {

/// Irradiance at a receiver and how it changes to first order; world coordinates.
struct FirstOrder {
  double irradiance = 0.0;                                        ///< W/m^2
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();             ///< translational, tangential; W/m^3
  Eigen::Vector3d rotational_gradient = Eigen::Vector3d::Zero();  ///< with respect to a rotation vector; W/(m^2 rad)
};

/// Fewest rays with which a field offers records of known geometry: with fewer, faces that are seen and that no ray
/// hits take a share of the irradiance away (docs/derivations/known_geometry.md).
inline constexpr std::size_t kFewestRaysWithGeometry = 256;

/// First-order derivatives from samples in a scene whose geometry is known: exact visibility as a control variate.
///
/// With c_f the mean radiance of the samples that hit face f, E = E_c + (E - E_c), where E_c is the irradiance of the
/// scene in which face f has the constant radiance c_f everywhere. E_c and its gradient are exact (SceneEvaluator);
/// what is left is estimated from the same samples with the radiance L_i - c_f, which jumps less where one face hides
/// another. The noise of samples is that of jumps within a stratum, so most of it goes. Since c_f is of the same
/// samples the irradiance has a bias, of the order of n^(-3/2) for n rays, the square of its noise, as long as no face
/// is smaller than a stratum. docs/derivations/known_geometry.md.
class KnownGeometry {
 public:
  /// For gathers with concentric strata of the shape. Requires validated polygons. Throws as Strata does.
  KnownGeometry(std::span<const Polygon> polygons, GridShape shape);

  /// May be called from several threads at once. Requires samples of the shape at the receiver, in a frame with its
  /// normal. Where faces overlap in one plane, c_f is the mean over all faces of the plane. Throws InvalidScene as
  /// SceneEvaluator::evaluate does.
  FirstOrder firstOrder(const Receiver& receiver, const RoomSamples& gathered) const;

  /// With any radiances of the faces in place of the samples' means: the expected irradiance does not depend on them
  /// as long as they do not depend on the samples; the noise does. Requires one for each polygon.
  FirstOrder firstOrder(const Receiver& receiver, const RoomSamples& gathered, std::span<const double> radiances) const;

 private:
  std::vector<Polygon> polygons_;
  std::vector<std::size_t> faces_;   ///< each face by itself
  std::vector<std::size_t> planes_;  ///< of each face the first one in its plane
  std::unique_ptr<Estimator> walls_;
};

}  // namespace irradiff
