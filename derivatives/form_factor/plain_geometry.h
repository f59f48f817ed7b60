#pragma once

#include "derivatives/boundary/double_word.h"
#include "derivatives/form_factor/plain_view.h"

#include <cstddef>

namespace irradiff {

// What the plain rules take from doubled precision, in the units of a PlainView.

/// (a - b) scale without error.
Vector3<DoubleWord<double>> wideRelative(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double scale);

/// Where the horizon cuts the edge between a vertex that is seen and one that is not.
struct WideCut {
  DoubleWord<double> fraction;           ///< of the edge from the end that is seen
  Vector3<DoubleWord<double>> position;  ///< relative to the receiver
};

/// A cut is right to 16 u^2 of the distances of its edge's ends.
WideCut wideCut(const PlainView& view, const Polygon& polygon, const Receiver& receiver, std::size_t seen,
                std::size_t hidden);

/// Whether the receiver is certainly out of the polygon's plane, by far more than rounding of coordinates:
/// evaluatePolygon has rules for receivers on a surface.
bool isOffPlane(const PlainView& view, const Polygon& polygon, const Receiver& receiver);

}  // namespace irradiff
