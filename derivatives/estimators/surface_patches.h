#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/strata.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace irradiff {

/// Derivatives of what one stratum adds to the irradiance, per unit of radiance: of a patch that stays at the stratum's
/// hit, in the plane of the surface there, whatever moves before or behind it. In the frame (t, b, n).
struct PatchDerivatives {
  Eigen::Vector3d gradient;  ///< 1/m
  /// 1/m^2, symmetric. The entry (n, n) holds for patches that the horizon does not cut.
  Eigen::Matrix3d hessian;
};

/// The patches behind strata of one stratification and shape (Jarosz, Schönefeld, Kobbelt, Jensen, "Theory, Analysis
/// and Applications of 2D Global Illumination", 2012, carried to 3D; docs/derivations/sample_estimators.md, section
/// "Occlusion-unaware"). May be used from several threads at once.
class SurfacePatches {
 public:
  explicit SurfacePatches(const Strata& strata);

  /// For each stratum the plane of the surface at its hit as the vector q for which q.p = 1 on the plane, p from the
  /// receiver; 0 where the ray hit nothing. 1/m. Requires samples of the strata's stratification and shape.
  ///
  /// Samples have no surface normals. A plane is taken through the hit and those of two neighbours, one across a row
  /// and one across a column: of the four pairs the one that gives the plane farthest from the receiver, since a pair
  /// beyond an edge gives a steeper one. A hit at the rim of a surface may have no good pair, so the planes of the
  /// neighbours, moved in parallel to this hit, are compared as well. Where there is no plane at all it faces the
  /// receiver.
  std::vector<Eigen::Vector3d> inversePlanes(const HemisphereSamples& samples) const;

  /// Of the stratum `stratum` with its `inverse_plane`; 0 if its ray hit nothing.
  PatchDerivatives derivatives(const HemisphereSamples& samples, std::size_t stratum,
                               const Eigen::Vector3d& inverse_plane) const;

 private:
  Strata strata_;
};

}  // namespace irradiff
