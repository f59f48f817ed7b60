#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <string>

namespace irradiff {

enum class PolygonRule {
  kBelowHorizon,  ///< nothing of the polygon rises above the horizon
  kOwnSurface,    ///< the receiver lies on the polygon, which faces it edge-on: the surface the receiver belongs to
  kEdgeOn,        ///< the receiver lies in the polygon's plane, outside the polygon
  kBoundary,
  kArea,
};

/// What one polygon of radiance 1 adds, and how it was found. Seen edge-on, the derivatives are those of the signed
/// form factor times pi: irradiance itself has a kink.
struct PolygonEvaluation {
  IrradianceDerivatives<double> derivatives;
  DerivativeBounds bounds;
  PolygonRule rule = PolygonRule::kBoundary;
  bool crosses_horizon = false;
  bool is_clockwise = false;  ///< the vertices run clockwise seen from the receiver: the signed form factor is positive
  std::string no_gradient;    ///< why the gradient does not exist; empty if it does
  std::string no_hessian;     ///< why the Hessian does not exist; empty if it does
};

// Irradiance of one unoccluded polygon of radiance 1 at the receiver, seen from either side, with its gradient, Hessian
// and rotational gradient. Coordinates are scaled by a power of two, differences of them enter exactly, polygons small
// compared with their distance are integrated over their area and the others along their boundary. Units: 1, 1/m,
// 1/m^2. Error, norm-wise: 2e-14 for well-conditioned polygons, 1e-13 in the families of docs/accuracy.md, and at most
// `bounds` always. A polygon in the receiver's own surface adds exactly nothing (docs/derivations/error_bounds.md,
// section 5). Throws InvalidScene, naming the polygon and `index`, if the receiver is on one of its edges or vertices,
// inside it without being on its surface's own normal, if numbers are so small beside others that their products
// underflow, or if a result exceeds the range of double. Requires validated arguments.
PolygonEvaluation evaluatePolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver);

// What evaluatePolygon finds before it integrates: derivatives and bounds are 0, and kBoundary stands for kArea too.
// Throws as evaluatePolygon does, but for results beyond the range of double. Requires validated arguments.
PolygonEvaluation classifyPolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver);

}  // namespace irradiff
