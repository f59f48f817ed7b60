#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <span>

namespace irradiff {

/// An irradiance and an estimate of its error.
struct SliceIntegral {
  double irradiance;
  double error;
};

/// The irradiance of a scene without edges, arcs, planes of view or exact signs: the hemisphere is cut into half planes
/// through the receiver's normal. Each meets the polygons in segments; between the zenith angles at which a segment
/// ends or two cross, the nearest one radiates, which integrates in closed form. What is left is an integral over the
/// azimuth, bisected wherever its slices do not show the same pieces in the same order, down to 1e-11, and wherever it
/// does not converge to `tolerance`.
///
/// Requires |n| = 1, and a receiver in the plane of no polygon.
SliceIntegral irradianceBySlices(std::span<const Polygon> scene, const Receiver& receiver, double tolerance = 1e-12);

}  // namespace irradiff
