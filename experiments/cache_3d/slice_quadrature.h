#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "experiments/cache_3d/slice_view.h"
#include "experiments/cache_3d/surface_radiance.h"

#include <span>
#include <vector>

namespace irradiff {

/// How finely slices are integrated. Steps along a segment end wherever the table's cells do, so that the radiance is a
/// polynomial in each; the other ends are these. finerSteps() tells what is left.
struct SliceSteps {
  double distances = 0.35;        ///< longest step along a segment, in distances from the receiver
  double azimuth = 0.35;          ///< widest panel before it is judged; rad
  double tolerance = 2e-5;        ///< largest difference of two rules in a panel, as a share of the irradiance
  double gradient_length = 0.01;  ///< and of the gradient times this share of the extent of the scene
};

/// Irradiance and its gradient in the tangent plane, in world axes. W/m^2, W/m^3.
struct SliceIrradiance {
  double irradiance = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// The irradiance from surfaces of any tabulated radiance, with all occlusion, without samples: half-planes through the
/// normal cut the scene into segments, of which the nearest are found exactly; along those the integral over the
/// elevation is by Gauss-Legendre, that over the azimuth by adaptive Gauss-Kronrod panels between the azimuths at which
/// what is seen changes its order. docs/derivations/slice_quadrature.md.
class SliceQuadrature {
 public:
  /// Keeps copies of the polygons and a reference to the radiance, whose faces they are.
  SliceQuadrature(std::span<const Polygon> polygons, const SurfaceRadiance& radiance, const SliceSteps& steps = {});

  /// The gradient is that of the same integral: of the radiance along the surfaces and of the ends of what is seen,
  /// which move with the receiver. A receiver in the plane of a face to within rounding does not see it. May be called
  /// from several threads at once. Throws std::invalid_argument if the irradiance is not a number, as of
  /// lengths whose squares are beyond the range of double.
  SliceIrradiance at(const Receiver& receiver) const;

  /// The slices that the last call of this thread has integrated.
  static std::size_t lastSliceCount();

 private:
  std::vector<Polygon> polygons_;
  const SurfaceRadiance* radiance_;
  SceneOutline outline_;
  double extent_;  ///< m
  SliceSteps steps_;
};

}  // namespace irradiff
