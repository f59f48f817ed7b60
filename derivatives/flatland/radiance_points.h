#pragma once

#include "derivatives/flatland/flatland_estimate.h"

#include <Eigen/Core>

#include <span>

namespace irradiff {

/// A point of the scene in whose direction radiance jumps: the flatland radiance boundary consists of these.
struct RadiancePoint {
  Eigen::Vector2d direction;      ///< unit, in the frame (t, n)
  double inverse_distance = 0.0;  ///< 1/m
  double jump = 0.0;              ///< radiance counterclockwise of the direction minus that clockwise; W/(m rad)
};

// Gives the estimate gradient and Hessian of the radiance boundary that consists of these points:
//   grad E = sum dL G,  hess E = -sum dL G',  G(r) = (n.r) J r/|r|^3
// docs/derivations/flatland.md, sections 2 and 6. Exact for fixed points, whatever hides what: no apparent vertices in
// flatland. A point on the horizon adds nothing, as a cut there (section 3).
void setDerivatives(FlatlandEstimate& estimate, std::span<const RadiancePoint> points);

}  // namespace irradiff
