#pragma once

#include "derivatives/samples/sample_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// Vertices of a mesh in a frame whose third axis is the receiver's normal: unit directions and inverse distances
/// (1/m), arrays of the same length.
struct MeshVertices {
  std::span<const double> t, b, n;
  std::span<const double> inverse_distance;
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

// Gradient and Hessian of the irradiance from the triangles of `mesh`, each with the radiance of its farthest corner
// (of equally far ones, the first), Eqs. (9) and (10) of [Schwarzhaupt et al. 2012]. A triangle that turns over counts
// negative, as its form factor does: the mesh covers every direction once. Evaluated once an edge with the radiance
// jump across it as the weight; an edge without a jump costs nothing more. docs/derivations/sample_estimators.md,
// section 2. Nothing is divided by what the vertices could make zero: coincident vertices and points at infinity have
// finite terms, and edges that lie on the horizon or pass through the receiver add nothing. Radiance and inverse
// distance are scaled by powers of two, so that a result is not finite only where it exceeds the range of double.
// Error, norm-wise: kChordArcError u times the sum of the terms' sizes (chordArcTerms).
// Requires the samples' radiances (W/(m^2 sr), finite), as many `samples` as the mesh has, and as many vertices
// `on_horizon` as it has outermost samples if it is closed; each of those has the radiance of the sample it belongs to.
MeshDerivatives meshDerivatives(const SampleMesh& mesh, const MeshVertices& samples, std::span<const double> radiance,
                                const MeshVertices& on_horizon,
                                VectorInstructions instructions = vectorInstructions().back());

}  // namespace irradiff
