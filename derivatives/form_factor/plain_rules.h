#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/vector.h"
#include "derivatives/form_factor/plain_boundary.h"
#include "derivatives/form_factor/plain_view.h"

#include <array>
#include <cstddef>

namespace irradiff {

/// What a plain rule makes of a polygon of radiance 1, in the units of its PlainView and with the sign of the form
/// factor, and bounds of its errors that hold where they are finite.
struct PlainResult {
  double irradiance = 0.0;
  Vector3<double> vector_irradiance = Vector3<double>::Zero();  ///< without its part along the normal where cut
  Vector3<double> gradient = Vector3<double>::Zero();
  Matrix3<double> hessian = Matrix3<double>::Zero();
  DerivativeBounds bounds;  ///< the rotational gradient's is that of the vector irradiance
  /// What the bounds of evaluatePolygon come to at least; 0 where that is not known.
  DerivativeBounds least_bounds;
};

/// Where plain double is out of its depth: infinite bounds.
PlainResult withoutBounds();

/// How the sum over the boundary is to be taken.
struct PlainBoundarySettings {
  std::array<std::size_t, kAngleBins> series_lengths;  ///< seriesLengthsFor()
  /// r x e that cancels to less than one over this is taken from doubled precision, edge by edge.
  double largest_cancellation;
  /// A cut at the horizon that plain double places worse, relative to its distance, is taken from doubled precision.
  double largest_shift;
};

/// Error of r x e in plain double, in units of u |r||e|.
inline constexpr double kPlainMomentError = 4.5;
/// Rounding errors of the area rule in units of u, with the sizes of section 3 of docs/derivations/rule_choice.md.
inline constexpr double kPlainAreaError = 64.0;

/// The sum over the boundary. Requires a view that is above the horizon or crosses it. Bounds are infinite where plain
/// double is out of its depth.
PlainResult plainBoundary(const PlainView& view, const Polygon& polygon, const Receiver& receiver,
                          const PlainBoundarySettings& settings);

inline constexpr std::size_t kMostPlainNodes = 8;
/// The extent up to which the truncation of the area rule is bounded.
inline constexpr double kLargestPlainExtent = 0.5;

/// Bound of the quadrature error of the area rule's second derivatives, relative to the size of its largest term, for
/// a source of this extent. Requires 1 <= nodes <= kMostPlainNodes.
double plainAreaTruncation(std::size_t nodes, double extent);

/// How the integral over the area is to be taken.
struct PlainAreaSettings {
  std::size_t nodes;      ///< in each direction of a triangle, from 1 to kMostPlainNodes
  bool compensates_area;  ///< A and A.p are taken from doubled precision
};

/// The area rule: nodes x nodes nodes of Stroud's conical product in each triangle of a fan, exact for polynomials of
/// degree 2 nodes - 1; of what is above the horizon. Requires an extent of at most kLargestPlainExtent.
PlainResult plainArea(const PlainView& view, const Polygon& polygon, const Receiver& receiver,
                      const PlainAreaSettings& settings);

}  // namespace irradiff
