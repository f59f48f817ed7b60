#pragma once

#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <cstddef>
#include <string>

namespace irradiff {

/// What one polygon of radiance 1 adds according to the appendix form. A quantity that the form leaves without a finite
/// value has a reason here or in the base, and is 0.
struct AppendixEvaluation : PolygonEvaluation {
  std::string no_irradiance;          ///< why irradiance and rotational gradient have no value; empty if they have
  std::string no_tangential_hessian;  ///< why the tangential Hessian has no value; empty if it has
};

// The counterpart of evaluatePolygon by the appendix form of [Schwarzhaupt et al. 2012] (appendix_form.h, angles by
// atan2) in plain double: neither scaled nor compensated. A polygon that crosses the horizon is cut there and closed
// along it. The closing edges move with the receiver, so the Hessian loses the term that the form gives them as fixed
// edges (docs/derivations/radiance_boundary.md, section 6).
// Units: 1, 1/m, 1/m^2. Error: unbounded by itself, so `bounds` is measured: the distance from evaluatePolygon's result
// plus the bound of that one. What is degenerate for evaluatePolygon (edge-on, own surface, below the horizon) is taken
// over from it. Throws as evaluatePolygon does. Requires validated arguments.
AppendixEvaluation evaluateAppendix(const Polygon& polygon, std::size_t index, const Receiver& receiver);

}  // namespace irradiff
