#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <string>

namespace irradiff {

/// What one segment of radiance 1 adds, and how it was found. The flatland counterpart of PolygonEvaluation.
struct SegmentEvaluation {
  IrradianceDerivatives<double, 2> derivatives;
  DerivativeBounds bounds;
  bool crosses_horizon = false;
  std::string no_gradient;  ///< why the gradient does not exist; empty if it does
  std::string no_hessian;   ///< why the Hessian does not exist; empty if it does
};

// Irradiance of one unoccluded segment of radiance 1 at the receiver, seen from either side, with its gradient, Hessian
// and rotational gradient. Boundary form, or Gauss-Legendre quadrature of the defining integral along segments that are
// small compared with their distance (docs/derivations/flatland.md). Units: 1, 1/m, 1/m^2. Error: at most `bounds`,
// norm-wise. Throws InvalidScene, naming the segment and `index`, if the receiver is on one of its ends, inside it
// without being on its surface's own normal, or if a result exceeds the range of double. Requires validated arguments.
SegmentEvaluation evaluateSegment(const Segment& segment, std::size_t index, const FlatlandReceiver& receiver);

}  // namespace irradiff
