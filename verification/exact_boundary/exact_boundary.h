#pragma once

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/double_word.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/radiance_boundary.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "verification/enclosure/ball.h"
#include "verification/exact_boundary/rational_geometry.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace irradiff {

/// What exactVisibility() sees, handed on without rounding to the boundary formulas at any scalar: double,
/// multiprecision numbers, balls.
///
///     const ExactBoundary exact = exactBoundary(exactVisibility(polygons, receiver), polygons, receiver);
///     const IrradianceDerivatives<Ball> derivatives = sumsOf<Ball>(exact, receiver.normal).derivatives;

/// An arc across which radiance jumps, relative to the receiver, metres.
struct RationalArc {
  RationalVector begin;
  RationalVector end;
  Rational begin_height;  ///< n.begin, exactly 0 on the horizon
  Rational end_height;
  Rational radiance_jump;  ///< right minus left, W/(m^2 sr)
};

/// What is seen just above the horizon, counterclockwise by less than half a turn.
struct RationalHorizonArc {
  RationalVector begin;
  RationalVector end;
  double radiance;
};

struct ExactBoundary {
  std::vector<RationalArc> arcs;
  std::vector<RationalHorizonArc> horizon;
  /// What the motion of apparent vertices adds to the Hessian: the sum over all ends of arcs, exactly. Its
  /// antisymmetric part cancels that of the arcs. W/m^4.
  RationalMatrix vertex_hessian;
  std::size_t apparent_vertices = 0;  ///< directions in which an end of an arc moves
  std::string no_gradient;            ///< why it does not exist; empty if it does
  std::string no_hessian;
};

/// Requires that `seen` is exactVisibility() of these polygons and this receiver. Polygons seen edge-on have no image
/// and give no reason here. `radiances` of the polygons in W/(m^2 sr).
///
/// A vertex term at each end of an arc (r, e) that the line (r', e') cuts, + at its upper end, - at its lower:
///   dL (r x e) (n.p*)/|p*|^4 (dt*/dx)^T,   dt*/dx = (w' - p* x e')/(e.w'),   w' = r' x e'
/// docs/derivations/radiance_boundary.md, section 5. It is rational and is summed as such.
ExactBoundary exactBoundary(const ExactVisibility& seen, const std::vector<Polygon>& polygons,
                            std::span<const double> radiances, const Receiver& receiver);

/// The rational number as a Scalar: rounded, for a ball enclosed.
template <class Scalar>
Scalar scalarFrom(const Rational& number) {
  if constexpr (std::floating_point<Scalar>) {
    return number.convert_to<Scalar>();
  } else if constexpr (std::same_as<Scalar, DoubleWord<double>>) {
    const auto high = number.convert_to<double>();
    return {high, Rational(number - Rational(high)).convert_to<double>()};
  } else if constexpr (std::same_as<Scalar, Ball>) {
    return Ball::fromDecimal(boost::multiprecision::numerator(number).str()) /
           Ball::fromDecimal(boost::multiprecision::denominator(number).str());
  } else {
    return Scalar(boost::multiprecision::numerator(number)) / Scalar(boost::multiprecision::denominator(number));
  }
}

template <class Scalar>
Vector3<Scalar> vectorFrom(const RationalVector& v) {
  return {scalarFrom<Scalar>(v[0]), scalarFrom<Scalar>(v[1]), scalarFrom<Scalar>(v[2])};
}

/// Arcs and horizon at the scalar. The positions are the rational ones, rounded once.
template <class Scalar>
RadianceBoundary<Scalar> radianceBoundary(const ExactBoundary& exact, const Vector3<Scalar>& normal) {
  using std::atan2;
  using WideScalar = Wide<Scalar>;
  RadianceBoundary<Scalar> boundary;
  for (const RationalArc& arc : exact.arcs) {
    const ClippedVertex<Scalar, WideScalar> begin{vectorFrom<WideScalar>(arc.begin),
                                                  scalarFrom<Scalar>(arc.begin_height)};
    const ClippedVertex<Scalar, WideScalar> end{vectorFrom<WideScalar>(arc.end), scalarFrom<Scalar>(arc.end_height)};
    appendEdgeArcs(begin, end, normal, scalarFrom<Scalar>(arc.radiance_jump), boundary.arcs);
  }
  for (const RationalHorizonArc& arc : exact.horizon) {
    const Vector3<Scalar> begin = vectorFrom<Scalar>(withoutLength(arc.begin));
    const Vector3<Scalar> end = vectorFrom<Scalar>(withoutLength(arc.end));
    const Scalar angle =
        norm(normal) * lift<Scalar>(arc.radiance) * Scalar(atan2(norm(cross(begin, end)), dot(begin, end)));
    boundary.horizon_angle = boundary.horizon_angle + angle;
    boundary.horizon_size = boundary.horizon_size + angle;
  }
  return boundary;
}

/// E, gradient and Hessian with the terms of apparent vertices. Meaningless where `exact` says why there is none.
template <class Scalar>
BoundarySums<Scalar> sumsOf(const ExactBoundary& exact, const Vector3<Scalar>& normal) {
  BoundarySums<Scalar> sums = boundarySums(radianceBoundary<Scalar>(exact, normal), normal);
  Matrix3<Scalar> vertices;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto row = static_cast<std::size_t>(i);
      const auto column = static_cast<std::size_t>(j);
      vertices(i, j) = scalarFrom<Scalar>((exact.vertex_hessian[row][column] + exact.vertex_hessian[column][row]) / 2);
    }
  }
  Matrix3<Scalar>& hessian = sums.derivatives.hessian.value;
  const Matrix2<Scalar> tangential = tangentialHessian(vertices, normal).value;
  Matrix2<Scalar>& tangential_sum = sums.derivatives.tangential_hessian.value;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) hessian(i, j) = hessian(i, j) + vertices(i, j);
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) tangential_sum(i, j) = tangential_sum(i, j) + tangential(i, j);
  }
  return sums;
}

}  // namespace irradiff
