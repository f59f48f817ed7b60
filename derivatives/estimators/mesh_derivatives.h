#pragma once

#include "derivatives/samples/sample_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// Samples in a frame whose third axis is the receiver's normal: arrays of the same length.
struct MeshSamples {
  std::span<const double> t, b, n;           ///< unit directions, n >= 0
  std::span<const double> inverse_distance;  ///< 1/m, finite, >= 0
  std::span<const double> radiance;          ///< W/(m^2 sr), finite, >= 0
};

/// Derivatives of the irradiance from the triangles of a mesh, in the frame of its vertices.
struct MeshDerivatives {
  Eigen::Vector3d gradient;  ///< W/m^3
  Eigen::Matrix3d hessian;   ///< W/m^4, symmetric; its first two rows and columns are the tangential Hessian
};

/// Vector instructions that the sums are compiled for. All give the same bits.
enum class VectorInstructions { kNone, kAvx2, kAvx512 };

/// Those that this machine has, the widest last; kNone is always there.
std::vector<VectorInstructions> vectorInstructions();

// Gradient and Hessian of the irradiance from the triangles of `mesh`, each with the radiance of its farthest sample
// (of equally far ones, the first): Eqs. (9) and (10) of [Schwarzhaupt et al. 2012]. A triangle that turns over counts
// negative, as its form factor does, so that the mesh covers every direction once. A vertex on the horizon is at
// infinity in the direction of its sample's azimuth, and counts as its sample where the farthest one is looked for.
//
// Evaluated once an edge with the radiance jump across it as the weight; where there is none, nothing is evaluated.
// docs/derivations/sample_estimators.md, "Sample meshes". No sample is divided by: coincident ones and misses have
// finite terms. An edge that passes through the receiver (to rounding) or lies on the horizon adds nothing. Powers of
// two bring radiance and inverse distance near 1: a result is not finite only where it exceeds the range of double.
//
// Error, norm-wise: kChordArcError u times the sum of the terms' sizes (chordArcTerms), and the rounding of the sum.
// Requires as many samples as the mesh has.
MeshDerivatives meshDerivatives(const SampleMesh& mesh, const MeshSamples& samples,
                                VectorInstructions instructions = vectorInstructions().back());

}  // namespace irradiff
