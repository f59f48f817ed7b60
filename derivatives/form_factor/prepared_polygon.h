#pragma once

#include "derivatives/boundary/horizon_clip.h"
#include "derivatives/form_factor/polygon_evaluation.h"

#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// The polygon and the receiver in units of 2^exponent metres, in which the farthest vertex is between 1/2 and 2 away.
struct ScaledPolygon {
  std::vector<Vector3<double>> vertices;
  Vector3<double> position;
  int exponent;
  Vector3<double> largest_coordinates;  ///< along each axis
};

/// A polygon and a receiver, made ready for integration where anything is seen.
struct PreparedPolygon {
  PolygonEvaluation evaluation;  ///< without derivatives
  ScaledPolygon scaled;
  ClippedPolygon<double> clipped;  ///< empty if there is nothing to integrate
  double orientation = 0.0;        ///< > 0 where the vertices run clockwise
  double sine_to_plane = 0.0;
};

/// Classifies the polygon, scales it and cuts it at the horizon: what evaluatePolygon and certifyPolygon integrate.
/// Throws as classifyPolygon does.
PreparedPolygon preparePolygon(const Polygon& polygon, std::size_t index, const Receiver& receiver);

/// Throws InvalidScene: the polygon and its index, the receiver's position, then `rule`.
[[noreturn]] void rejectReceiver(const Polygon& polygon, std::size_t index, const Receiver& receiver,
                                 const std::string& rule);

}  // namespace irradiff
