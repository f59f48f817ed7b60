#pragma once

#include "derivatives/boundary/irradiance.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/certified/rung.h"
#include "verification/enclosure/ball.h"

#include <cstddef>
#include <optional>

namespace irradiff {

/// What one polygon of radiance 1 adds, with proven bounds.
struct CertifiedPolygon {
  /// Values rounded to double; `bounds` are proven for the given doubles taken as exact, that rounding included.
  PolygonEvaluation evaluation;
  Rung rung = Rung::kDouble;  ///< the highest that was climbed
  /// What the values are the rounded midpoints of; only above the rung of double.
  std::optional<IrradianceDerivatives<Ball>> enclosure;
  bool misses_tolerance = false;  ///< even the last rung did not suffice; a bound may be infinite
};

/// Climbs the rungs until every bound meets `tolerance` (rung.h says relative to what).
/// Throws InvalidScene as evaluatePolygon does and std::invalid_argument for a tolerance outside
/// [kSmallestTolerance, 1]. Requires validated arguments.
CertifiedPolygon certifyPolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver, double tolerance);

/// What one rung alone makes of the polygon, whether it meets the tolerance or not; only Rung::kBall looks at that.
CertifiedPolygon certifyPolygonAt(Rung rung, const Polygon& polygon, std::size_t index, const Receiver& receiver,
                                  double tolerance);

}  // namespace irradiff
