#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/flatland/segment_form.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <string>

namespace irradiff {

/// What becomes of one segment by itself. The flatland counterpart of PolygonRule.
enum class SegmentRule {
  kBelowHorizon,  ///< nothing of the segment rises above the horizon
  kOwnSurface,    ///< the receiver lies on it: it is not seen and hides nothing
  kEndOn,         ///< the receiver lies on its line, outside the segment
  kBoundary,      ///< by its ends
  kLength,        ///< by quadrature along it
};

/// What one segment of radiance 1 adds, and how it was found. The flatland counterpart of PolygonEvaluation.
struct SegmentEvaluation {
  IrradianceDerivatives<double, 2> derivatives;
  DerivativeBounds bounds;
  bool crosses_horizon = false;
  SegmentRule rule = SegmentRule::kBoundary;
  std::string no_gradient;  ///< why the gradient does not exist; empty if it does
  std::string no_hessian;   ///< why the Hessian does not exist; empty if it does
};

// Irradiance of one unoccluded segment of radiance 1 at the receiver, seen from either side, with its gradient, Hessian
// and rotational gradient. Boundary form, or Gauss-Legendre quadrature of the defining integral along segments that are
// small compared with their distance (docs/derivations/flatland.md). Units: 1, 1/m, 1/m^2. Error: at most `bounds`,
// norm-wise. Throws InvalidScene, naming the segment and `index`, if the receiver is on one of its ends, inside it
// without being on its surface's own normal, or if a result exceeds the range of double. Requires validated arguments.
SegmentEvaluation evaluateSegment(const Segment& segment, std::size_t index, const FlatlandReceiver& receiver);

// The same for the part of a segment between two points that are seen from the receiver, relative to it and scaled by
// 2^-exponent so that the farther one is about 1 away; `sine_to_line` is that of the angle between the edge and the
// direction of the first, or less where the points themselves carry errors. Units 1, 1/m, 1/m^2 before the scaling.
// Results may be infinite.
SegmentEvaluation evaluateClipped(const ClippedSegment<double>& clipped, const Vector2<double>& normal,
                                  double sine_to_line, int exponent);

}  // namespace irradiff
