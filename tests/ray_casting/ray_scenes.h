#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace irradiff {

/// A right-handed frame about the receiver's normal, turned by an angle that depends on the seed.
SampleFrame frameAt(const Receiver& receiver, std::uint64_t seed);

/// Samples without hits in cosine-weighted random directions; the strata play no part.
HemisphereSamples randomDirections(const SampleFrame& frame, std::uint64_t seed, std::size_t count);

/// Samples without hits in the given directions of the frame, which are normalised.
HemisphereSamples samplesAlong(const SampleFrame& frame, std::span<const Eigen::Vector3d> directions);

/// `count` small squares at random around the receiver, some of them through others.
std::vector<Polygon> scatteredSquares(std::uint64_t seed, std::size_t count);

/// A closed surface of triangles about the origin: an octahedron whose faces were divided `levels` times, its vertices
/// at distances from 1 to 2 and not on any grid.
std::vector<Polygon> closedSurface(std::uint64_t seed, int levels);

}  // namespace irradiff
