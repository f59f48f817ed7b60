#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <span>
#include <string>

namespace irradiff {

/// Irradiance of a scene at one receiver with its derivatives, their bounds, and what the scene required.
/// Units: W/m^2, W/m^3, W/m^4 for radiance in W/(m^2 sr); one power of metre less in flatland.
template <int Dimension>
struct SceneEvaluation {
  IrradianceDerivatives<double, Dimension> derivatives;
  DerivativeBounds bounds;
  bool crosses_horizon = false;  ///< some radiating source was cut at the horizon
  // Why a quantity has no value at the receiver; empty if it has. Its value and bound above are then meaningless.
  std::string no_irradiance;  ///< for the rotational gradient too; only the appendix form leaves these without a value
  std::string no_gradient;
  std::string no_hessian;
  std::string no_tangential_hessian;
};

/// How each polygon is evaluated.
enum class PolygonMethod {
  kBoundary,  ///< evaluatePolygon: the production path
  kAppendix,  ///< evaluateAppendix: the form of the 2012 paper, for comparison
};

/// The sum over polygons that do not hide each other from the receiver.
///
/// Throws InvalidScene where one polygon hides part of another and at least one of the two radiates, and as
/// evaluatePolygon does. Two polygons hide each other if their interiors, above the horizon and as seen from the
/// receiver, overlap by more than the rounding of coordinates can move them: touching is allowed. Requires validated
/// arguments. O(n^2) in the number of triangles.
SceneEvaluation<3> evaluateUnoccluded(std::span<const Polygon> polygons, const Receiver& receiver,
                                      PolygonMethod method = PolygonMethod::kBoundary);

/// The same for segments in flatland.
SceneEvaluation<2> evaluateUnoccluded(std::span<const Segment> segments, const FlatlandReceiver& receiver);

}  // namespace irradiff
